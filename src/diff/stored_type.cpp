#include "diff/stored_type.h"

namespace skylapse::diff {

using image::SampleStorage;

int precision_bits(const SampleStorage& s) {
  switch (s.kind) {
    case SampleStorage::Kind::integer:
      return s.bits;
    case SampleStorage::Kind::half_float:
      return 11;
    case SampleStorage::Kind::float32:
      return s.bits > 32 ? 53 : 24;
    case SampleStorage::Kind::rgbe:
      return 8;
  }
  return 0;
}

std::string type_name(const SampleStorage& s) {
  switch (s.kind) {
    case SampleStorage::Kind::integer:
      return "uint" + std::to_string(s.bits);
    case SampleStorage::Kind::half_float:
      return "half";
    case SampleStorage::Kind::float32:
      return s.bits > 32 ? "double" : "float";
    case SampleStorage::Kind::rgbe:
      return "rgbe";
  }
  return {};
}

}  // namespace skylapse::diff
