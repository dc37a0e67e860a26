#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace skylapse {

/// SHA-256 of `bytes` as 64 lower-case hexadecimal digits (FIPS 180-4, through Nettle).
std::string sha256_hex(std::span<const std::byte> bytes);
std::string sha256_hex(std::string_view text);

}  // namespace skylapse
