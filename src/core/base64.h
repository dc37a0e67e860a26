#pragma once
// Bytes inside text (RFC 4648, section 4).
#include <cstddef>
#include <span>
#include <string>

namespace skylapse {

/// Four characters for every three bytes, padded with "=".
std::string base64(std::span<const std::byte> bytes);

}  // namespace skylapse
