// What access depends on, out of a request that Boost.Beast has parsed. Only where requests are read.
#pragma once

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <iterator>

#include "hamilcar/live/access.hpp"

namespace hamilcar::live {

namespace beast = boost::beast;
using Upgrade = beast::http::request<beast::http::empty_body>;

inline std::string_view view_of(boost::beast::string_view text) {
    return {text.data(), text.size()};
}

// Empty if it is absent or repeated.
inline std::string_view header_of(const Upgrade& request, beast::http::field name) {
    const auto [first, last] = request.equal_range(name);
    if (first == last || std::next(first) != last) return {};
    return view_of(first->value());
}

inline HttpRequest request_of(const Upgrade& request) {
    return {.method = view_of(request.method_string()),
            .target = view_of(request.target()),
            .host = header_of(request, beast::http::field::host),
            .origin = header_of(request, beast::http::field::origin),
            .cookie = header_of(request, beast::http::field::cookie),
            .upgrade = beast::websocket::is_upgrade(request)};
}

}  // namespace hamilcar::live
