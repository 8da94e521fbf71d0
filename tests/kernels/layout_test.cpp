// Records mean the same on both sides: every field written by name on the device is read back by
// name on the host, and the kernels' texel fetches put every word where it belongs.
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "device_fixture.hpp"
#include "kernel.hpp"
#include "layout_fields.h"
#include "ppm_pass_test_shaders.hpp"
#include "shared/layout.h"

namespace ppm::tests {
namespace {

using namespace ppm::shared;

struct RangePush {
  std::uint32_t first = 0, count = 0;
};

#define RECORD(type, name, fields) type name[2];
struct Records {
  PPM_ALL_RECORDS
};
#undef RECORD

class Layout : public DeviceTest {
 protected:
  // Records that the kernel fetches: words 1, 2, 3 ... as floats or integers, whatever they are.
  template <class Record>
  static std::vector<Record> numbered(std::uint32_t start) {
    std::vector<Record> records(2);
    std::vector<std::uint32_t> words(2 * sizeof(Record) / 4);
    for (std::uint32_t& word : words) word = start++;
    std::memcpy(records.data(), words.data(), words.size() * 4);
    return records;
  }

  void run() {
    gpu::BindingTable table;
    table.set(PPM_BIND_TEST_0, records_);
    table.set(PPM_BIND_TEST_1, fetched_);
    table.set(PPM_BIND_MATERIALS, materials_);
    table.set(PPM_BIND_LIGHTS, lights_);
    table.set(PPM_BIND_TRIANGLE_POSITIONS, positions_);
    table.set(PPM_BIND_SCENE_CONSTANTS, constants_);
    const gpu::Kernel kernel(device(), shaders::layout_probe);
    device().run([&](gpu::Recorder& recorder) {
      recorder.fill(records_, 0, records_.bytes());
      recorder.dispatch(kernel, table, RangePush{}, 1);
    });
  }

  template <class Record>
  gpu::Buffer upload(const std::vector<Record>& records, gpu::Usage usage) {
    return gpu::make_buffer(device(), "records", std::span<const Record>(records), usage);
  }

  // Bit patterns of ordinary floats, so that nothing is flushed to zero on the way.
  static constexpr std::uint32_t kWords = 0x40000000u;

  gpu::Buffer records_{device(), "records", sizeof(Records), gpu::Usage::storage};
  gpu::Buffer fetched_{device(), "fetched", 1024, gpu::Usage::storage};
  std::vector<MaterialRecord> material_records_ = numbered<MaterialRecord>(kWords);
  std::vector<LightRecord> light_records_ = numbered<LightRecord>(kWords + 1000);
  std::vector<TrianglePositions> position_records_ = numbered<TrianglePositions>(kWords + 2000);
  std::vector<SceneConstants> constant_records_ = numbered<SceneConstants>(kWords + 3000);
  gpu::Buffer materials_ = upload(material_records_, gpu::Usage::texels);
  gpu::Buffer lights_ = upload(light_records_, gpu::Usage::texels);
  gpu::Buffer positions_ = upload(position_records_, gpu::Usage::texels);
  gpu::Buffer constants_ = upload(constant_records_, gpu::Usage::uniform);
};

// Fields are listed first, record by record, and compared in a loop: hundreds of expectations in
// one function take minutes to compile with sanitizers.
template <class Value>
class Fields {
 public:
  struct Field {
    std::string name;
    Value value;
  };

  [[gnu::noinline]] void add(const char* record, const char* name, Value value) {
    fields_.push_back({std::string(record) + ": " + name, value});
  }
  std::size_t size() const { return fields_.size(); }
  const Field& operator[](std::size_t i) const { return fields_[i]; }

 private:
  std::vector<Field> fields_;
};

#define U1(v) list.add(record, #v, static_cast<float>(v));
#define U2(v) U1(v.x) U1(v.y)
#define U3(v) U2(v) U1(v.z)
#define U4(v) U3(v) U1(v.w)
#define F1(v) list.add(record, #v, v);
#define F2(v) F1(v.x) F1(v.y)
#define F3(v) F2(v) F1(v.z)

TEST_F(Layout, EveryFieldIsWhereTheHostLooks) {
  run();
  Records records;
  records_.download(&records, sizeof(records));
  Fields<float> list;  // small integers
#define RECORD(type, name, fields)                                             \
  for (const type& field_of : records.name) {                                  \
    [&list](const char* record, const type& r) { fields(r) }(#name, field_of); \
  }
  PPM_ALL_RECORDS
#undef RECORD
  for (std::size_t n = 0; n < list.size(); ++n) {
    EXPECT_EQ(list[n].value, static_cast<float>(n + 1)) << list[n].name;
  }
  // No field of a record is missing from the list: all words are accounted for.
  EXPECT_EQ(4 * list.size(), sizeof(Records));
}

#undef U1
#undef F1
#undef F3
#define U1(v) list.add(record, #v, v);
#define F1(v) list.add(record, #v, floatBitsToUint(v));
#define F3(v) F1(v.x) F1(v.y) F1(v.z)

TEST_F(Layout, FetchesPutEveryWordWhereItBelongs) {
  run();
  const auto fetched = fetched_.download<std::uint32_t>(256);
  Fields<std::uint32_t> list;
  const char* record = "fetched";
  const MaterialRecord& material = material_records_[1];
  PPM_FIELDS_MATERIAL_RECORD(material)
  const LightRecord& light = light_records_[1];
  PPM_FIELDS_LIGHT_RECORD(light)
  const TrianglePositions& corners = position_records_[1];
  const SceneConstants& constants = constant_records_[0];
  F3(corners.corner0)
  U1(corners.material)
  F3(corners.corner1)
  F3(corners.corner2)
  PPM_FIELDS_SCENE_CONSTANTS(constants)
  ASSERT_LE(list.size(), fetched.size());
  for (std::size_t n = 0; n < list.size(); ++n)
    EXPECT_EQ(fetched[n], list[n].value) << list[n].name;
}

}  // namespace
}  // namespace ppm::tests
