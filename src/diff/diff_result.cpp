#include "diff/diff_result.h"

namespace skylapse::diff {

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::same:
      return "same";
    case Verdict::warning:
      return "warning";
    case Verdict::different:
      return "different";
  }
  return {};
}

}  // namespace skylapse::diff
