// JSON to and from text where the text, or what is to be written, may be anybody's.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hamilcar::io {

// Beyond this depth a document is refused: what handles it recurses.
inline constexpr std::size_t max_json_depth = 64;

// Whether brackets stand deeper inside each other than that.
bool is_too_deep(std::string_view json);

// Discarded (`is_discarded`) for what is no JSON or too deep; never throws.
template <class Json = nlohmann::json>
Json parse_json(std::string_view text) {
    if (is_too_deep(text)) return Json::value_t::discarded;
    return Json::parse(text, nullptr, false);
}

// Bytes that are no UTF-8, as in file names, become U+FFFD. `indent` -1: on one line.
template <class Json>
std::string json_text(const Json& json, int indent = 2) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace hamilcar::io
