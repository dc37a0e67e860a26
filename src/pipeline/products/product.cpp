#include "pipeline/products/product.h"

namespace skylapse::pipeline {

Result<std::vector<ProductFile>> make_product(const ProductRequest& request, StageTimes&) {
  switch (request.output.kind) {
    case config::ProductKind::specular:
    case config::ProductKind::irradiance:
    case config::ProductKind::harmonics:
    case config::ProductKind::sun:
    case config::ProductKind::dome:
      break;
  }
  return Error{ErrorCode::internal, "this product has no maker"};
}

}  // namespace skylapse::pipeline
