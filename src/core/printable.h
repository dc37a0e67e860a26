#pragma once
// Text from outside as it may be shown: in messages, on a terminal, in JSON.
#include <string>
#include <string_view>

namespace skylapse {

/// Bytes of the UTF-8 character at `at`, 0 if it is malformed, overlong, a surrogate, or beyond
/// U+10FFFF (RFC 3629, section 4).
size_t utf8_length(std::string_view text, size_t at);

/// The text with a question mark for each byte that is no UTF-8 and each control character but tab
/// and line end: well-formed, and unable to steer a terminal.
std::string printable(std::string_view text);

/// The text for XML 1.0, between tags or in quotes. Characters that XML does not know even so
/// (section 2.2: U+FFFE, U+FFFF) are question marks; control characters are left to printable().
std::string xml_escaped(std::string_view text);

/// At most `bytes` bytes of the beginning, cut between two characters.
std::string_view beginning(std::string_view text, size_t bytes);

/// The beginning of a text for a message, with "..." if it goes on.
std::string shown(std::string_view text);

}  // namespace skylapse
