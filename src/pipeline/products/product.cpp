#include "pipeline/products/product.h"

#include "pipeline/products/dome.h"
#include "pipeline/products/harmonics.h"
#include "pipeline/products/irradiance.h"
#include "pipeline/products/specular.h"
#include "pipeline/products/sun_light.h"

namespace skylapse::pipeline {

Result<std::vector<ProductFile>> make_product(const ProductRequest& request, StageTimes& times) {
  switch (request.output.kind) {
    case config::ProductKind::specular:
      return make_specular(request, times);
    case config::ProductKind::irradiance:
      return make_irradiance(request, times);
    case config::ProductKind::harmonics:
      return make_harmonics(request, times);
    case config::ProductKind::sun:
      return make_sun(request);
    case config::ProductKind::dome:
      return make_dome(request, times);
  }
  return Error{ErrorCode::internal, "this product has no maker"};
}

}  // namespace skylapse::pipeline
