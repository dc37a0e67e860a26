#include "fuzz/require.h"

namespace skylapse::fuzz {
namespace {

/// Bytes of the character that begins with `lead`, 0 if none does.
int character_length(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead < 0xE0) return 2;
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  return lead >= 0xF0 && lead < 0xF5 ? 4 : 0;
}

/// The second byte excludes overlong forms, surrogates and what lies beyond U+10FFFF.
bool good_second(unsigned char lead, unsigned char second) {
  const unsigned char lowest = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
  const unsigned char highest = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
  return second >= lowest && second <= highest;
}

}  // namespace

bool is_clean_text(std::string_view text) {
  for (size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const int length = character_length(lead);
    if (length == 0 || i + size_t(length) > text.size()) return false;
    if (lead == 0x7F || (lead < 0x20 && lead != '\t' && lead != '\n')) return false;
    for (int k = 1; k < length; ++k) {
      const auto byte = static_cast<unsigned char>(text[i + size_t(k)]);
      if ((byte & 0xC0) != 0x80 || (k == 1 && !good_second(lead, byte))) return false;
    }
    i += size_t(length);
  }
  return true;
}

void require_printable(const Diagnostics& errors) {
  require(!errors.empty(), "a refusal has a reason");
  for (const Error& error : errors) {
    require(!error.message.empty(), "an error has words");
    const std::string printed = format_error(error);
    require(is_clean_text(printed), "errors are clean text", printed);
    require(printed.size() < 4000, "errors are short", printed);
    require(error.span.line >= 0 && error.span.length >= 0, "places are sensible", printed);
    require(error.span.line == 0 || error.span.column >= 1, "columns count from 1", printed);
  }
}

}  // namespace skylapse::fuzz
