// What host and dispatch_counts.comp pass to each other.
#ifndef PPM_SHARED_DISPATCH_COUNTS_H
#define PPM_SHARED_DISPATCH_COUNTS_H

#include "shared/lang.h"

// Ranges that one counted dispatch is cut into at most.
#define PPM_COUNTED_RANGES 256

PPM_NAMESPACE_BEGIN

struct DispatchCountsPush {
  uint word, rows;      // counts are words[word .. word + rows)
  uint most;            // no row is taken to have more
  uint ranges, step;    // ranges <= PPM_COUNTED_RANGES
  uint workgroup_size;  // of the kernel that is dispatched
  uint command;         // the first range's, of three words each
};

PPM_NAMESPACE_END

#endif  // PPM_SHARED_DISPATCH_COUNTS_H
