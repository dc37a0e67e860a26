#include "astro/time/zone_file.h"

#include <fstream>
#include <iterator>

namespace skylapse::astro {

std::filesystem::path zone_folder() {
  const std::filesystem::path usual = "/usr/share/zoneinfo";
  std::error_code none;
  return std::filesystem::is_directory(usual / "uclibc", none) ? usual / "uclibc" : usual;
}

bool is_zone_file(const std::string& name) {
  constexpr size_t kHeaderSize = 44;
  std::ifstream file(zone_folder() / name, std::ios::binary);
  std::string header(kHeaderSize, '\0');
  return file.read(header.data(), kHeaderSize) && header.starts_with("TZif");
}

std::optional<PosixZone> read_zone_footer(const std::string& name) {
  std::ifstream file(zone_folder() / name, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  constexpr size_t kHeaderSize = 44;
  const bool has_footer = bytes.size() > kHeaderSize && bytes.starts_with("TZif") &&
                          bytes[4] >= '2' && bytes.back() == '\n';
  if (!has_footer) return std::nullopt;
  const size_t line_end = bytes.size() - 1;
  const size_t line_break = bytes.rfind('\n', line_end - 1);
  if (line_break == std::string::npos) return std::nullopt;
  return PosixZone::parse(
      std::string_view(bytes).substr(line_break + 1, line_end - line_break - 1));
}

}  // namespace skylapse::astro
