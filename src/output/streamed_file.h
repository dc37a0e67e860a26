#pragma once
// A file that is written piece by piece and appears whole.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "core/result.h"
#include "output/image_writer.h"

namespace skylapse::output {

struct FileHash {
  std::string sha256;
  uintmax_t bytes = 0;
};
/// Of a file of any size, a piece at a time. Errors: missing_input.
Result<FileHash> hash_of_file(const std::filesystem::path& path);

/// A hidden temporary beside `path` until it is published; removed if it never is.
class StreamedFile final : public ByteSink {
 public:
  /// Makes missing parent folders. Errors: write_failed.
  static Result<std::unique_ptr<StreamedFile>> create(const std::filesystem::path& path);
  ~StreamedFile() override;
  StreamedFile(const StreamedFile&) = delete;
  StreamedFile& operator=(const StreamedFile&) = delete;

  bool write_at(uint64_t offset, std::span<const std::byte> bytes) override;

  /// Hashes what was written and renames it to its path. Errors: write_failed, also of any
  /// write_at before.
  Result<FileHash> publish();

  /// The error of the first write that failed, if one did.
  [[nodiscard]] Status status() const;
  /// Time spent in the system's writes and in publish.
  [[nodiscard]] double milliseconds() const { return milliseconds_; }

 private:
  StreamedFile(std::filesystem::path path, std::filesystem::path temporary, int descriptor);
  std::filesystem::path path_, temporary_;
  int descriptor_ = -1;
  int error_number_ = 0;
  double milliseconds_ = 0;
};

}  // namespace skylapse::output
