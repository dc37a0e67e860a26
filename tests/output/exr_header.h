#pragma once
// A reader of OpenEXR headers of its own, so that tests see what is in the file and not what
// OpenImageIO makes of it. Layout: OpenEXR technical documentation, "File Layout".
#include <bit>
#include <cstring>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace skylapse::output {

struct ExrAttribute {
  std::string type;
  std::vector<std::byte> value;

  [[nodiscard]] std::string text() const {
    return {reinterpret_cast<const char*>(value.data()), value.size()};
  }
  template <class T>
  [[nodiscard]] T as() const {
    if (value.size() != sizeof(T)) throw std::runtime_error("attribute of another size");
    T v;
    std::memcpy(&v, value.data(), sizeof v);
    return v;
  }
};

/// Attributes by name. Throws std::runtime_error on anything that is no single-part EXR.
inline std::map<std::string, ExrAttribute> read_exr_header(std::span<const std::byte> file) {
  size_t at = 0;
  const auto need = [&](size_t n) {
    if (file.size() - at < n) throw std::runtime_error("header ends early");
  };
  const auto int32 = [&] {
    need(4);
    int v;
    std::memcpy(&v, file.data() + at, 4);
    at += 4;
    return v;
  };
  const auto name = [&] {
    std::string s;
    for (need(1); file[at] != std::byte{0}; need(1)) s += static_cast<char>(file[at++]);
    ++at;
    return s;
  };
  if (int32() != 20000630) throw std::runtime_error("no OpenEXR magic number");
  if ((int32() & 0xff) != 2) throw std::runtime_error("not version 2");
  std::map<std::string, ExrAttribute> all;
  for (std::string key = name(); !key.empty(); key = name()) {
    ExrAttribute a{name(), {}};
    const auto size = static_cast<size_t>(int32());
    need(size);
    a.value.assign(file.begin() + static_cast<std::ptrdiff_t>(at),
                   file.begin() + static_cast<std::ptrdiff_t>(at + size));
    at += size;
    all[key] = a;
  }
  return all;
}

}  // namespace skylapse::output
