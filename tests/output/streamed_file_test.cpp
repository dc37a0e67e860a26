#include "output/streamed_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/sha256.h"
#include "output/atomic_file.h"
#include "output/image_fixture.h"

namespace skylapse::output {
namespace {

size_t files_in(const std::filesystem::path& folder) {
  size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++files;
  return files;
}

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto* const begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

TEST(StreamedFile, AppearsWholeWithTheHashOfWhatWasWrittenInAnyOrder) {
  const TemporaryFolder folder;
  const auto path = folder / "deep/er/f.bin";
  auto file = StreamedFile::create(path);
  ASSERT_TRUE(file.ok());
  EXPECT_TRUE((*file)->write_at(3, bytes_of("defg")));
  EXPECT_TRUE((*file)->write_at(0, bytes_of("abcD")));
  EXPECT_FALSE(std::filesystem::exists(path));
  const auto published = (*file)->publish();
  ASSERT_TRUE(published.ok());
  EXPECT_EQ(published->bytes, 7u);
  EXPECT_EQ(published->sha256, sha256_hex(std::string_view("abcDefg")));
  EXPECT_EQ(*read_file(path), bytes_of("abcDefg"));
  EXPECT_EQ(hash_of_file(path)->sha256, published->sha256);
}

TEST(StreamedFile, LeavesNothingIfItIsNotPublished) {
  const TemporaryFolder folder;
  {
    auto file = StreamedFile::create(folder / "f.bin");
    ASSERT_TRUE(file.ok());
    (*file)->write_at(0, bytes_of("abc"));
  }
  EXPECT_EQ(files_in(folder.path()), 0u);
}

TEST(StreamedFile, APlaceThatCannotBeWrittenIsAWriteError) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_file_atomically(folder / "f", bytes_of("abc")));
  const auto below_a_file = StreamedFile::create(folder / "f/g.bin");
  ASSERT_FALSE(below_a_file.ok());
  EXPECT_EQ(below_a_file.error().code, ErrorCode::write_failed);
  EXPECT_EQ(hash_of_file(folder / "missing").error().code, ErrorCode::missing_input);
}

/// Every format, type and packing that we write.
std::vector<EncodeRequest> all_kinds(const std::vector<float>& rgb, const std::vector<uint8_t>& u8,
                                     const std::vector<uint16_t>& u16) {
  std::vector<EncodeRequest> kinds{
      request("hdr", SampleType::float32, rgb.data()), request("png", SampleType::u8, u8.data()),
      request("png", SampleType::u16, u16.data()),     request("jpg", SampleType::u8, u8.data()),
      request("tif", SampleType::float32, rgb.data()), request("tif", SampleType::u8, u8.data())};
  for (const char* compression : {"none", "zip", "zips", "piz", "dwaa"})
    for (const SampleType type : {SampleType::half_float, SampleType::float32}) {
      kinds.push_back(request("exr", type, rgb.data()));
      kinds.back().compression = compression;
    }
  return kinds;
}

size_t bytes_of_sample(const EncodeRequest& r) {
  return r.type == SampleType::u8 ? 1 : r.type == SampleType::u16 ? 2 : 4;
}

TEST(RowWriter, RowsInAnyPortionsGiveTheBytesOfTheWholeImage) {
  const auto rgb = gradient();
  const auto u8 = codes<uint8_t>();
  const auto u16 = codes<uint16_t>();
  const TemporaryFolder folder;
  for (const EncodeRequest& kind : all_kinds(rgb, u8, u16)) {
    const auto whole = image_io().encode(kind);
    ASSERT_TRUE(whole.ok()) << format_error(whole.error());
    for (const int portion : {1, 5, 16, 22}) {
      auto file = StreamedFile::create(folder / "f");
      ASSERT_TRUE(file.ok());
      auto rows = image_io().open_rows(kind, **file);
      ASSERT_TRUE(rows.ok());
      const auto* const begin = static_cast<const std::byte*>(kind.pixels);
      for (int y = 0; y < kHeight; y += portion)
        ASSERT_TRUE((*rows)->add(begin + size_t{3} * kWidth * y * bytes_of_sample(kind),
                                 std::min(portion, kHeight - y)));
      ASSERT_TRUE((*rows)->finish());
      const auto published = (*file)->publish();
      ASSERT_TRUE(published.ok());
      EXPECT_EQ(published->sha256, sha256_hex(*whole))
          << kind.format << " " << kind.compression << " in portions of " << portion;
    }
  }
}

/// A sink that is full after 100 bytes.
class FullSink final : public ByteSink {
 public:
  bool write_at(uint64_t offset, std::span<const std::byte> bytes) override {
    return offset + bytes.size() <= 100;
  }
};

TEST(RowWriter, ASinkThatFailsEndsInAnErrorForEveryFormat) {
  const auto rgb = gradient();
  const auto u8 = codes<uint8_t>();
  const auto u16 = codes<uint16_t>();
  for (const EncodeRequest& kind : all_kinds(rgb, u8, u16)) {
    FullSink sink;
    auto rows = image_io().open_rows(kind, sink);
    if (!rows) continue;
    const Status added = (*rows)->add(kind.pixels, kHeight);
    const Status finished = (*rows)->finish();
    EXPECT_FALSE(added && finished) << kind.format << " " << kind.compression;
  }
}

}  // namespace
}  // namespace skylapse::output
