#include "output/imageio/display.h"

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "output/imageio/builtin_config.h"
#include "output/imageio/scene_space.h"
#include "output/imageio/staged_processor.h"

namespace OCIO = OCIO_NAMESPACE;

namespace skylapse::output::imageio {
namespace {

/// A quarter of an 8-bit code: what the quick form of a transform may differ from the exact one.
constexpr float kTolerance = 0.25f / 255.0f;

class OcioDisplay final : public DisplayTransform {
 public:
  OcioDisplay(OCIO::ConstCPUProcessorRcPtr plain, std::unique_ptr<StagedProcessor> staged)
      : plain_(std::move(plain)), staged_(std::move(staged)) {}
  void apply(float* rgb, size_t pixels) const override {
    // Pieces that stay in the nearest cache from the first stage to the last.
    constexpr size_t kPiece = 1024;
    for (size_t done = 0; done < pixels; done += kPiece) {
      const size_t count = std::min(kPiece, pixels - done);
      limit(rgb + 3 * done, 3 * count);
      if (staged_)
        staged_->apply(rgb + 3 * done, count);
      else
        apply_processor(*plain_, rgb + 3 * done, count);
    }
  }

 private:
  /// Infinite radiance must come out white: the squares within the transforms would overflow and
  /// show it black, like NaN.
  static void limit(float* samples, size_t count) {
    constexpr float kFar = 1e12f;  // its square is still finite; the sun is 1e9 at most
    for (size_t i = 0; i < count; ++i)
      samples[i] = samples[i] > kFar ? kFar : (samples[i] < -kFar ? -kFar : samples[i]);
  }

  OCIO::ConstCPUProcessorRcPtr plain_;
  std::unique_ptr<StagedProcessor> staged_;  // null: use plain_
};

Error invalid(std::string message, std::string hint) {
  return {.code = ErrorCode::invalid_input, .message = std::move(message), .hint = std::move(hint)};
}

Result<OCIO::ConstConfigRcPtr> open_config(const std::string& config_file) {
  const char* const environment = std::getenv("OCIO");
  const bool from_environment = config_file.empty() && environment != nullptr && *environment != 0;
  if (config_file.empty() && !from_environment) return builtin_config();
  const std::string path = from_environment ? environment : config_file;
  const std::string origin = from_environment ? " (named by $OCIO)" : "";
  std::error_code ec;
  if (!std::filesystem::is_regular_file(path, ec))
    return Error{.code = ErrorCode::missing_input,
                 .message = "cannot read OCIO config '" + path + "'" + origin,
                 .hint = from_environment ? "unset OCIO to use the built-in ACES config" : ""};
  try {
    auto config = OCIO::Config::CreateFromFile(path.c_str());
    config->validate();
    return config;
  } catch (const OCIO::Exception& e) {
    return invalid("OCIO config '" + path + "'" + origin + ": " + e.what(), "");
  }
}

std::vector<std::string> displays_of(const OCIO::Config& config) {
  std::vector<std::string> names;
  for (int i = 0; i < config.getNumDisplays(); ++i) names.emplace_back(config.getDisplay(i));
  return names;
}

std::vector<std::string> views_of(const OCIO::Config& config, const std::string& display) {
  std::vector<std::string> names;
  for (int i = 0; i < config.getNumViews(display.c_str()); ++i)
    names.emplace_back(config.getView(display.c_str(), i));
  return names;
}

/// `wanted`, or `fallback` when it is empty; an unknown name is an error with what there is.
Result<std::string> choose(const std::string& what, const std::string& wanted,
                           const std::string& fallback, const std::vector<std::string>& known) {
  if (wanted.empty() && !fallback.empty()) return fallback;
  if (std::find(known.begin(), known.end(), wanted) != known.end()) return wanted;
  std::string hint = "known: ";
  for (size_t i = 0; i < known.size(); ++i) hint += (i > 0 ? ", " : "") + known[i];
  if (known.empty()) hint = "the OCIO config defines none";
  if (const auto near = nearest_name(wanted, known)) hint += "; did you mean " + *near + "?";
  return invalid("unknown " + what + " '" + wanted + "'", hint);
}

OCIO::MatrixTransformRcPtr ocio_matrix(const glm::dmat3& m) {
  auto transform = OCIO::MatrixTransform::Create();
  const double rows[16] = {m[0][0], m[1][0], m[2][0], 0, m[0][1], m[1][1], m[2][1], 0,
                           m[0][2], m[1][2], m[2][2], 0, 0,       0,       0,       1};
  transform->setMatrix(rows);
  return transform;
}

}  // namespace

Result<std::unique_ptr<DisplayTransform>> make_display_transform(const DisplayRequest& request) {
  const auto space = color::rgb_space_from_name(request.scene_space);
  if (!space) return space.error();
  const auto config = open_config(request.config_file);
  if (!config) return config.error();
  const OCIO::Config& c = **config;
  const auto display = choose("display", request.display, c.getDefaultDisplay(), displays_of(c));
  if (!display) return display.error();
  const auto view =
      choose("view", request.view, c.getDefaultView(display->c_str()), views_of(c, *display));
  if (!view) return view.error();
  const auto scene = find_scene_space(c, *space);
  if (!scene) return scene.error();
  try {
    auto to_view = OCIO::DisplayViewTransform::Create();
    to_view->setSrc(scene->name.c_str());
    to_view->setDisplay(display->c_str());
    to_view->setView(view->c_str());
    auto all = OCIO::GroupTransform::Create();
    all->appendTransform(ocio_matrix(scene->matrix));
    all->appendTransform(to_view);
    const auto processor = c.getProcessor(all);
    return std::unique_ptr<DisplayTransform>(std::make_unique<OcioDisplay>(
        processor->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_VERY_GOOD),
        StagedProcessor::build(*config, processor, kTolerance)));
  } catch (const OCIO::Exception& e) {
    return invalid("display '" + *display + "', view '" + *view + "': " + e.what(), "");
  }
}

Result<std::vector<std::string>> list_views(const std::string& config_file) {
  const auto config = open_config(config_file);
  if (!config) return config.error();
  std::vector<std::string> all;
  const auto add = [&](const std::string& display, const std::string& view) {
    std::string name = display + "/" + view;
    if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(std::move(name));
  };
  const auto add_display = [&](const std::string& display) {
    add(display, (*config)->getDefaultView(display.c_str()));
    for (const std::string& view : views_of(**config, display)) add(display, view);
  };
  if ((*config)->getNumDisplays() > 0) add_display((*config)->getDefaultDisplay());
  for (const std::string& display : displays_of(**config)) add_display(display);
  return all;
}

}  // namespace skylapse::output::imageio
