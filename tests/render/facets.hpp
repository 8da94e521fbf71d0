// Surfaces of GGX facets in double precision, by integrals over these.
#pragma once

namespace ppm::test {

/// Shares of light that comes from a direction of this cosine and goes back or through, once: GGX
/// facets of this alpha (height-correlated Smith masking on either side), each of which reflects
/// and refracts by Fresnel's equations with `eta`, the index beyond over the one on the side of the
/// light. thin: a sheet of index eta whose facets mirror light through it instead of bending it.
struct FacetShares {
  double reflected = 0.0, transmitted = 0.0;
};
FacetShares facet_shares(double alpha, double eta, double cosine, bool thin = false);

/// What a GGX lobe with Schlick's Fresnel term reflects of light from a direction of this cosine:
/// light that meets a second facet is lost.
double coat_share(double alpha, double f0, double f90, double cosine);

}  // namespace ppm::test
