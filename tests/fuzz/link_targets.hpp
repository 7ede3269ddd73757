// What any bytes at all from the network must come through: requests and messages (targets.hpp).
#pragma once

#include <boost/asio/buffer.hpp>
#include <nlohmann/json.hpp>

#include "fuzz/targets.hpp"
#include "hamilcar/live/http_request.hpp"
#include "hamilcar/live/messages.hpp"

namespace hamilcar::fuzz {

// A stranger who knows neither token nor cookie does not get in.
inline void run_request(std::string_view bytes) {
    static const live::Access access({.token = "T0ken", .once = "0nce", .session = "C00kie", .folder = "p1ace"}, 8080);
    live::beast::http::request_parser<live::beast::http::empty_body> parser;
    live::beast::error_code error;
    parser.put(boost::asio::buffer(bytes.data(), bytes.size()), error);
    if (error || !parser.is_header_done()) return;
    const auto has = [&](std::string_view what) { return bytes.find(what) != bytes.npos; };
    const bool local = has("127.0.0.1:8080") || has("localhost:8080");
    switch (access.judge(live::request_of(parser.get()))) {
        case 200:
            demand(local && (has("T0ken") || has("0nce") || (has("C00kie") && has("/p1ace/"))),
                   "a page for a stranger");
            break;
        case 101: demand(local && has("C00kie") && has("/p1ace/live"), "a link for a stranger"); break;
        case 403:
        case 404:
        case 405:
        case 426: break;
        default: demand(false, "an answer of another kind");
    }
}

inline void run_message(std::string_view bytes) {
    const auto read = live::read_message(bytes);
    if (const auto* invalid = std::get_if<live::InvalidMessage>(&read)) {
        demand(!invalid->message.empty(), "a refusal without a reason");
        const auto told = nlohmann::json::parse(live::refusal_message(invalid->message), nullptr, false);
        demand(told.is_object() && told["type"] == "refusal", "a refusal that is no message");
        return;
    }
    const auto& message = std::get<live::ClientMessage>(read);
    if (const auto* input = std::get_if<live::InputMessage>(&message)) {
        const live::Controls& c = input->controls;
        demand(std::abs(c.steer) <= 1 && c.throttle >= 0 && c.throttle <= 1 && c.brake >= 0 && c.brake <= 1 &&
                   c.clutch >= 0 && c.clutch <= 1 && c.gear >= 1 && c.gear <= max_gears,
               "controls beyond their limits");
    }
    if (const auto* pace = std::get_if<live::PaceMessage>(&message)) {
        demand(pace->factor >= 0.05 && pace->factor <= 1, "a pace beyond its limits");
    }
}

}  // namespace hamilcar::fuzz
