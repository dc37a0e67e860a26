#include "output/imageio/reader_choice.h"

#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <string_view>

#include "core/printable.h"

namespace skylapse::output::imageio {
namespace {

using namespace std::string_view_literals;

struct Mark {
  std::string_view bytes;
  size_t offset;
  std::string_view format;
};

constexpr std::array kMarks{
    Mark{"\x76\x2f\x31\x01"sv, 0, "openexr"},
    Mark{"\x89PNG\r\n\x1a\n"sv, 0, "png"},
    Mark{"\xff\xd8\xff"sv, 0, "jpeg"},
    Mark{"II*\0"sv, 0, "tiff"},
    Mark{"MM\0*"sv, 0, "tiff"},
    Mark{"II+\0"sv, 0, "tiff"},
    Mark{"MM\0+"sv, 0, "tiff"},
    Mark{"#?"sv, 0, "hdr"},
    Mark{"GIF8"sv, 0, "gif"},
    Mark{"SDPX"sv, 0, "dpx"},
    Mark{"XPDS"sv, 0, "dpx"},
    Mark{"\x80\x2a\x5f\xd7"sv, 0, "cineon"},
    Mark{"\xd7\x5f\x2a\x80"sv, 0, "cineon"},
    Mark{"DDS "sv, 0, "dds"},
    Mark{"SIMPLE  ="sv, 0, "fits"},
    Mark{"\0\0\1\0"sv, 0, "ico"},
    Mark{"FOR4"sv, 0, "iff"},
    Mark{"\0\0\0\x0cjP  "sv, 0, "jpeg2000"},
    Mark{"\xff\x4f\xff\x51"sv, 0, "jpeg2000"},
    Mark{"8BPS"sv, 0, "psd"},
    Mark{"\x01\xda"sv, 0, "sgi"},
    Mark{"\x53\x80\xf6\x34"sv, 0, "softimage"},
    Mark{"WEBP"sv, 8, "webp"},
    Mark{"ftypheic"sv, 4, "heif"},
    Mark{"ftypheix"sv, 4, "heif"},
    Mark{"ftypmif1"sv, 4, "heif"},
    Mark{"ftypavif"sv, 4, "heif"},
    Mark{"DICM"sv, 128, "dicom"},
    Mark{"BM"sv, 0, "bmp"},
};

/// Formats whose files do not say what they are, and those that say another's mark.
constexpr std::array kByName{"targa"sv, "rla"sv, "zfile"sv, "raw"sv};

bool has_mark(std::string_view head, const Mark& mark) {
  return head.size() >= mark.offset && head.substr(mark.offset).starts_with(mark.bytes);
}

bool is_pnm(std::string_view head) {
  return head.size() > 2 && head[0] == 'P' && "123456fF"sv.find(head[1]) != head.npos &&
         " \t\r\n#"sv.find(head[2]) != head.npos;
}

std::string lower_extension(const std::string& path) {
  const size_t slash = path.rfind('/');
  const size_t dot = path.rfind('.');
  if (dot == path.npos || (slash != path.npos && dot < slash)) return {};
  std::string extension = path.substr(dot + 1);
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return extension;
}

/// The format whose extension this is, out of kByName.
std::optional<std::string> format_by_name(const std::string& path) {
  const std::string extension = lower_extension(path);
  const auto formats = OIIO::get_extension_map();
  for (const std::string_view format : kByName) {
    const auto known = formats.find(std::string(format));
    if (known == formats.end()) continue;
    const auto& extensions = known->second;
    if (std::find(extensions.begin(), extensions.end(), extension) != extensions.end())
      return std::string(format);
  }
  return std::nullopt;
}

/// The first bytes of a regular file. Opened without waiting, for a pipe nobody writes to.
Result<std::string> head_of(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return unreadable(path, std::strerror(errno));
  struct stat facts {};
  std::string head(256, '\0');
  ssize_t got = -1;
  std::string why;
  if (::fstat(file, &facts) != 0)
    why = std::strerror(errno);
  else if (S_ISDIR(facts.st_mode))
    why = "it is a folder";
  else if (!S_ISREG(facts.st_mode))
    why = "it is not a regular file";
  else if ((got = ::pread(file, head.data(), head.size(), 0)) < 0)
    why = std::strerror(errno);
  else if (got == 0)
    why = "the file is empty";
  ::close(file);
  if (!why.empty()) return unreadable(path, why);
  head.resize(size_t(got));
  return head;
}

}  // namespace

Error unreadable(const std::string& path, const std::string& why) {
  return {.code = ErrorCode::missing_input,
          .message = "cannot read image '" + printable(path) + "': " + printable(why)};
}

std::vector<std::string> readable_extensions() {
  std::vector<std::string> all;
  for (const auto& [format, extensions] : OIIO::get_extension_map()) {
    const bool known = format == "pnm" || std::ranges::count(kByName, format) > 0 ||
                       std::ranges::count(kMarks, format, &Mark::format) > 0;
    if (known) all.insert(all.end(), extensions.begin(), extensions.end());
  }
  return all;
}

Result<std::string> reader_for(const std::string& path) {
  const auto head = head_of(path);
  if (!head) return head.error();
  const auto by_name = format_by_name(path);
  const auto* const mark =
      std::ranges::find_if(kMarks, [&](const Mark& m) { return has_mark(*head, m); });
  if (mark != kMarks.end()) {
    // Camera raws carry TIFF's mark.
    if (mark->format == "tiff" && by_name == "raw") return std::string("raw");
    return std::string(mark->format);
  }
  if (is_pnm(*head)) return std::string("pnm");
  if (by_name) return *by_name;
  return unreadable(path, "it is not an image of a known kind");
}

}  // namespace skylapse::output::imageio
