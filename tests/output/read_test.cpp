// Files read whole: channels, stored types, windows, turned pictures, and files that are no good.
#include <sys/stat.h>

#include <array>
#include <chrono>
#include <cstring>

#include "output/image_fixture.h"

namespace skylapse::output {
namespace {

using Kind = image::SampleStorage::Kind;

std::string write_bytes(const TemporaryFolder& folder, const std::string& name,
                        const std::string& bytes) {
  const auto path = folder / name;
  std::ofstream(path, std::ios::binary) << bytes;
  return path.string();
}

std::string encoded(const std::string& format, SampleType type) {
  static const auto eight = codes<uint8_t>();
  static const auto sixteen = codes<uint16_t>();
  static const auto floats = gradient();
  const void* pixels = type == SampleType::u8    ? static_cast<const void*>(eight.data())
                       : type == SampleType::u16 ? static_cast<const void*>(sixteen.data())
                                                 : static_cast<const void*>(floats.data());
  const auto bytes = image_io().encode(request(format, type, pixels));
  if (!bytes) throw std::runtime_error(bytes.error().message);
  return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
}

/// An uncompressed scanline EXR: any channels, any windows.
struct PlainExr {
  struct Channel {
    std::string name;
    int type;  // 0 uint, 1 half, 2 float
    int step = 1;
  };
  std::vector<Channel> channels;
  std::array<int32_t, 4> data{0, 0, 3, 1}, display{0, 0, 3, 1};

  static void put(std::string& out, const void* bytes, size_t size) {
    out.append(static_cast<const char*>(bytes), size);
  }
  template <class T>
  static void put(std::string& out, T value) {
    put(out, &value, sizeof value);
  }
  static void attribute(std::string& out, const char* name, const char* type,
                        const std::string& value) {
    put(out, name, std::strlen(name) + 1);
    put(out, type, std::strlen(type) + 1);
    put(out, int32_t(value.size()));
    out += value;
  }
  [[nodiscard]] std::string header() const {
    std::string out("\x76\x2f\x31\x01\x02\x00\x00\x00", 8), list;
    for (const Channel& c : channels) {
      put(list, c.name.c_str(), c.name.size() + 1);
      put(list, int32_t(c.type));
      put(list, int32_t(0));
      put(list, int32_t(c.step));
      put(list, int32_t(c.step));
    }
    list += '\0';
    attribute(out, "channels", "chlist", list);
    attribute(out, "compression", "compression", std::string(1, '\0'));
    attribute(out, "dataWindow", "box2i", {reinterpret_cast<const char*>(data.data()), 16});
    attribute(out, "displayWindow", "box2i", {reinterpret_cast<const char*>(display.data()), 16});
    attribute(out, "lineOrder", "lineOrder", std::string(1, '\0'));
    const float one = 1;
    attribute(out, "pixelAspectRatio", "float", {reinterpret_cast<const char*>(&one), 4});
    attribute(out, "screenWindowCenter", "v2f", std::string(8, '\0'));
    attribute(out, "screenWindowWidth", "float", {reinterpret_cast<const char*>(&one), 4});
    return out += '\0';
  }
  /// Channel c of pixel (x, y) holds 100 (y + 1) + 10 (x + 1) + c.
  [[nodiscard]] std::string file() const {
    std::string out = header();
    std::vector<std::string> rows;
    for (int y = data[1]; y <= data[3]; ++y) {
      std::string row;
      for (size_t c = 0; c < channels.size(); ++c) {
        if (y % channels[c].step != 0) continue;
        for (int x = data[0]; x <= data[2]; x += channels[c].step) {
          const int value = 100 * (y + 1) + 10 * (x + 1) + int(c);
          if (channels[c].type == 0)
            put(row, uint32_t(value));
          else
            put(row, float(value));
        }
      }
      rows.push_back(row);
    }
    uint64_t at = out.size() + 8 * rows.size();
    for (const std::string& row : rows) {
      put(out, at);
      at += 8 + row.size();
    }
    for (size_t i = 0; i < rows.size(); ++i) {
      put(out, int32_t(data[1] + int(i)));
      put(out, int32_t(rows[i].size()));
      out += rows[i];
    }
    return out;
  }
};

ReadImage read_ok(const std::string& path, int part = 0, const ReadLimits& limits = {}) {
  auto image = image_io().read(path, part, limits);
  if (!image) {
    ADD_FAILURE() << image.error().message;
    return {};
  }
  return *std::move(image);
}

TEST(ReadImage, TellsWhatEachFormatStores) {
  struct Case {
    const char* format;
    SampleType type;
    const char* name;
    Kind kind;
    int bits;
  };
  const Case cases[] = {{"exr", SampleType::float32, "openexr", Kind::float32, 32},
                        {"exr", SampleType::half_float, "openexr", Kind::half_float, 16},
                        {"hdr", SampleType::float32, "hdr", Kind::rgbe, 8},
                        {"png", SampleType::u8, "png", Kind::integer, 8},
                        {"png", SampleType::u16, "png", Kind::integer, 16},
                        {"jpg", SampleType::u8, "jpeg", Kind::integer, 8},
                        {"tif", SampleType::u16, "tiff", Kind::integer, 16},
                        {"tif", SampleType::float32, "tiff", Kind::float32, 32}};
  const TemporaryFolder folder;
  for (const Case& c : cases) {
    // The extension does not matter: the first bytes tell.
    const auto image = read_ok(write_bytes(folder, "picture.bin", encoded(c.format, c.type)));
    EXPECT_EQ(image.format, c.name);
    ASSERT_EQ(image.storage.size(), 3u) << c.format;
    EXPECT_EQ(image.storage[0].kind, c.kind) << c.format;
    EXPECT_EQ(image.storage[0].bits, c.bits) << c.format;
    EXPECT_EQ(image.storage[0].lossy, std::string(c.format) == "jpg");
    EXPECT_EQ(image.channels, (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_EQ(image.samples.size(), size_t{3} * kWidth * kHeight);
    EXPECT_EQ(image.parts, 1);
  }
}

TEST(ReadImage, KeepsFloatsAndScalesIntegers) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_ok(write_bytes(folder, "a.exr", encoded("exr", SampleType::float32))).samples,
            gradient());
  const auto sixteen = codes<uint16_t>();
  const auto image = read_ok(write_bytes(folder, "a.png", encoded("png", SampleType::u16)));
  for (size_t i = 0; i < sixteen.size(); ++i)
    ASSERT_FLOAT_EQ(image.samples[i], float(sixteen[i]) / 65535) << i;
}

TEST(ReadImage, CountsOfOpenExrStayCounts) {
  const TemporaryFolder folder;
  const PlainExr exr{.channels = {{"id", 0}, {"z", 2}}};
  const auto image = read_ok(write_bytes(folder, "a.exr", exr.file()));
  ASSERT_EQ(image.samples.size(), 16u);
  // OpenImageIO puts depth first.
  const size_t id = image.channels[0] == "id" ? 0 : 1;
  EXPECT_EQ(image.samples[id], 110);
  EXPECT_EQ(image.samples[1 - id], 111);
  EXPECT_EQ(image.samples[14 + id], 240);
  EXPECT_EQ(image.storage[id].kind, Kind::integer);
  EXPECT_EQ(image.storage[1 - id].kind, Kind::float32);
}

TEST(ReadImage, ShowsTheDisplayWindowOfOpenExr) {
  const TemporaryFolder folder;
  PlainExr exr{.channels = {{"Y", 2}}};
  exr.display = {-1, -1, 4, 2};  // a frame of one pixel around the data
  auto image = read_ok(write_bytes(folder, "cropped.exr", exr.file()));
  EXPECT_EQ(image.width, 6);
  EXPECT_EQ(image.height, 4);
  EXPECT_EQ(image.samples[0], 0);
  EXPECT_EQ(image.samples[6 * 1 + 1], 110);
  EXPECT_EQ(image.samples[6 * 2 + 4], 240);
  EXPECT_EQ(image.samples[6 * 2 + 5], 0);
  exr.display = {1, 1, 5, 1};  // its data begin before it and end in it
  image = read_ok(write_bytes(folder, "overscan.exr", exr.file()));
  EXPECT_EQ(image.samples, (std::vector<float>{220, 230, 240, 0, 0}));
  exr.display = {10, 10, 12, 12};
  const auto nothing = image_io().read(write_bytes(folder, "outside.exr", exr.file()), 0, {});
  ASSERT_FALSE(nothing.ok());
  EXPECT_NE(nothing.error().message.find("outside of its display window"), std::string::npos);
}

TEST(ReadImage, SubsampledChannelsAreRefusedByName) {
  const TemporaryFolder folder;
  PlainExr exr{.channels = {{"BY", 1, 2}, {"RY", 1, 2}, {"Y", 1}}};
  const auto image = image_io().read(write_bytes(folder, "yc.exr", exr.file()), 0, {});
  ASSERT_FALSE(image.ok());
  EXPECT_NE(image.error().message.find("ubsampled"), std::string::npos) << image.error().message;
}

TEST(ReadImage, TurnsPicturesAsTheySay) {
  const TemporaryFolder folder;
  const auto eight = codes<uint8_t>();
  const auto plain = read_ok(write_bytes(folder, "1.tif", encoded("tif", SampleType::u8)));
  const auto at = [&](const ReadImage& i, int x, int y) {
    return i.samples[3 * (size_t(y) * size_t(i.width) + size_t(x))];
  };
  for (const int orientation : {2, 3, 4, 5, 6, 7, 8}) {
    auto r = request("tif", SampleType::u8, eight.data());
    r.attributes.push_back({"Orientation", orientation});
    const auto bytes = image_io().encode(r);
    ASSERT_TRUE(bytes.ok());
    const auto image = read_ok(write_bytes(
        folder, "turned.tif", {reinterpret_cast<const char*>(bytes->data()), bytes->size()}));
    EXPECT_EQ(image.width, orientation >= 5 ? kHeight : kWidth);
    // The stored corner (0, 0) and its right neighbour, where viewers show them.
    const int right = image.width - 1, low = image.height - 1;
    const std::array<std::array<int, 4>, 9> shown{{{},
                                                   {},
                                                   {right, 0, right - 1, 0},
                                                   {right, low, right - 1, low},
                                                   {0, low, 1, low},
                                                   {0, 0, 0, 1},
                                                   {right, 0, right, 1},
                                                   {right, low, right, low - 1},
                                                   {0, low, 0, low - 1}}};
    const auto& s = shown[size_t(orientation)];
    EXPECT_EQ(at(image, s[0], s[1]), at(plain, 0, 0)) << orientation;
    EXPECT_EQ(at(image, s[2], s[3]), at(plain, 1, 0)) << orientation;
  }
}

TEST(ReadImage, FilesCutShortAreRefusedWhereverTheyAreCut) {
  const TemporaryFolder folder;
  const std::pair<const char*, SampleType> files[] = {
      {"exr", SampleType::float32}, {"exr", SampleType::half_float}, {"hdr", SampleType::float32},
      {"png", SampleType::u8},      {"png", SampleType::u16},        {"jpg", SampleType::u8},
      {"tif", SampleType::u8},      {"tif", SampleType::float32}};
  for (const auto& [format, type] : files) {
    const std::string whole = encoded(format, type);
    for (const size_t length : {size_t{0}, size_t{3}, size_t{20}, whole.size() / 4,
                                whole.size() / 2, whole.size() * 9 / 10, whole.size() - 2}) {
      const auto path = write_bytes(folder, std::string("cut.") + format, whole.substr(0, length));
      const auto image = image_io().read(path, 0, {});
      ASSERT_FALSE(image.ok()) << format << " cut to " << length << " of " << whole.size();
      EXPECT_EQ(image.error().code, ErrorCode::missing_input);
      EXPECT_GT(image.error().message.size(), path.size() + 20) << "the reason is missing";
    }
  }
}

TEST(ReadImage, HugeHeadersCostNothing) {
  const TemporaryFolder folder;
  PlainExr exr{.channels = {{"Y", 2}}};
  exr.data = exr.display = {0, 0, 2147483646, 2147483646};
  std::string png = encoded("png", SampleType::u8);
  for (const size_t at : {size_t{16}, size_t{20}}) png.replace(at, 4, "\x7f\xff\xff\xff", 4);
  std::string long_attribute = PlainExr{.channels = {{"Y", 2}}}.file();
  const size_t size = long_attribute.find("chlist") + 7;
  long_attribute.replace(size, 4, "\xff\xff\xff\x7f", 4);
  const std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2000000000 +X 2000000000\n";
  const std::pair<const char*, std::string> files[] = {
      {"window.exr", exr.header() + std::string(64, '\0')},
      {"size.png", png},
      {"attribute.exr", long_attribute},
      {"size.hdr", hdr + std::string(64, '\2')},
      {"size.pgm", "P5 2000000000 2000000000 255\n1234"}};
  for (const auto& [name, bytes] : files) {
    const auto begin = std::chrono::steady_clock::now();
    const auto image = image_io().read(write_bytes(folder, name, bytes), 0, {});
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    ASSERT_FALSE(image.ok()) << name;
    RecordProperty(name, std::to_string(seconds.count()));
  }
}

TEST(ReadImage, LimitsHoldForPixelsBytesAndChannels) {
  const TemporaryFolder folder;
  const auto path = write_bytes(folder, "a.exr", encoded("exr", SampleType::float32));
  const ReadLimits pixels{.pixels = kWidth * kHeight - 1},
      bytes{.bytes = 12 * kWidth * kHeight - 1}, channels{.channels = 2};
  for (const ReadLimits& limits : {pixels, bytes, channels})
    EXPECT_FALSE(image_io().read(path, 0, limits).ok());
  const ReadLimits just{.pixels = kWidth * kHeight, .bytes = 12 * kWidth * kHeight, .channels = 3};
  EXPECT_TRUE(image_io().read(path, 0, just).ok());
}

TEST(ReadImage, WhatIsNoFileIsRefusedWithoutWaiting) {
  const TemporaryFolder folder;
  const auto pipe = folder / "pipe.exr";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::pair<std::string, const char*> cases[] = {
      {folder.path().string(), "it is a folder"},
      {pipe.string(), "it is not a regular file"},
      {write_bytes(folder, "empty.exr", ""), "the file is empty"},
      {write_bytes(folder, "text.exr", "not an image at all"), "not an image of a known kind"},
      {(folder / "none.exr").string(), "No such file"}};
  for (const auto& [path, why] : cases) {
    const auto image = image_io().read(path, 0, {});
    ASSERT_FALSE(image.ok()) << path;
    EXPECT_NE(image.error().message.find(why), std::string::npos) << image.error().message;
  }
}

TEST(ReadImage, PartsThatAreNotThereAreAnError) {
  const TemporaryFolder folder;
  const auto path = write_bytes(folder, "a.exr", encoded("exr", SampleType::float32));
  EXPECT_FALSE(image_io().read(path, 1, {}).ok());
  EXPECT_FALSE(image_io().read(path, -1, {}).ok());
}

TEST(ReadImage, ACrashingReaderEndsInAnError) {
  // Found by mutation: OpenImageIO 2.4.7's reader of this format writes beyond its buffers.
  const auto image = image_io().read(
      std::string(SKYLAPSE_SOURCE_DIR) + "/tests/fuzz/corpus/image/crash.iff", 0, {});
  ASSERT_FALSE(image.ok());
  EXPECT_EQ(image.error().code, ErrorCode::missing_input);
  RecordProperty("message", image.error().message);
}

TEST(ReadImage, HeadersTellTheSameAsFiles) {
  const TemporaryFolder folder;
  const auto path = write_bytes(folder, "a.exr", encoded("exr", SampleType::half_float));
  const auto header = image_io().read_header(path, 0, {});
  ASSERT_TRUE(header.ok());
  const auto image = read_ok(path);
  EXPECT_EQ(header->width, image.width);
  EXPECT_EQ(header->channels, image.channels);
  EXPECT_EQ(header->storage, image.storage);
  EXPECT_TRUE(header->samples.empty());
}

}  // namespace
}  // namespace skylapse::output
