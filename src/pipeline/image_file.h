#pragma once
// One image output of a frame on its way into its file or files, a strip of rows at a time.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "image/irradiance.h"
#include "output/streamed_file.h"
#include "output/sun_policy.h"
#include "pipeline/frame_source.h"
#include "pipeline/output_view.h"

namespace skylapse::pipeline {

/// Rows of a picture, for all outputs that show it.
struct PictureStrip {
  int first_row = 0;         // among all rows, in the order in which files hold them
  image::FrameBuffer scene;  // with the disc, if it shows
  image::FrameBuffer sky;    // without it; empty where no output asks
  const image::FrameBuffer* standard_error = nullptr;
  std::optional<image::LevelWeights> weights;  // if the picture lights the level ground
};

/// Whether a file of the output is written without the disc that the picture has.
bool leaves_disc_apart(const config::ImageOutput& output);

/// An error of the sun policy, at the place in the config that chose it.
Error at_sun_policy(const config::ImageOutput& output, Error error);

/// What the sun policy did, for the manifest.
std::map<std::string, double> policy_record(const output::SunPolicyRecord& policy);

/// Adds to a file's record what it shines onto level ground, `held` in lux, beside what the sky of
/// the frame does.
void add_light_record(const FrameSource& source, const config::ImageOutput& output, double held,
                      std::map<std::string, double>& record);

class ImageFile {
 public:
  ImageFile(const FrameSource& source, size_t output, const OutputView& view,
            std::string fingerprint);

  /// Whether the picture has to be seen once before it is written.
  [[nodiscard]] bool needs_survey() const;
  /// Whether it shows the sky without the disc.
  [[nodiscard]] bool needs_sky() const;
  /// Whether its light on level ground can be held against that of the model.
  [[nodiscard]] bool is_weighed() const;
  void survey(const PictureStrip& strip);

  /// After the survey, before the first row. Errors: write_failed, or those of the sun policy.
  Status open();
  /// All rows, in order.
  Status add(const PictureStrip& strip);
  /// Publishes the files; one entry for each.
  Result<std::vector<LedgerEntry>> finish();

  [[nodiscard]] const StageTimes& times() const { return times_; }

 private:
  struct Part {
    std::unique_ptr<output::StreamedFile> file;
    std::unique_ptr<output::RowWriter> rows;
    double milliseconds_before = 0;
  };
  [[nodiscard]] const image::FrameBuffer& shown(const PictureStrip& strip) const;
  [[nodiscard]] output::FrameMetadata metadata() const;
  const void* stored_samples(const PictureStrip& strip);
  const void* display_samples(const PictureStrip& strip);
  const void* linear_samples(const PictureStrip& strip);
  Status write_rows(const void* samples, int first_row, int rows);
  Error failed(const Part& part, const Error& error) const;
  [[nodiscard]] std::map<std::string, double> encoding_record() const;

  const FrameSource& source_;
  const config::ImageOutput& output_;
  const output::DisplayTransform* display_;
  const OutputView& view_;
  std::string fingerprint_;
  std::vector<std::string> files_;
  output::SampleType type_;
  output::RangeSurvey survey_;
  std::optional<output::SunPolicyRecord> policy_;
  std::vector<Part> parts_;
  std::vector<float> values_;
  std::vector<uint8_t> u8_;
  std::vector<uint16_t> u16_;
  glm::dvec3 irradiance_{0};  // by what the file holds, in its own numbers
  StageTimes times_;
};

}  // namespace skylapse::pipeline
