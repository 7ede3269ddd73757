// Messages between page and server, as text and bytes. schemas/page.schema.json states them; the page's side is generated from it.
//
// A client message is accepted only if it is a flat object with exactly the fields of its type, each of the right type and within
// its range. Anything else is refused with an error message.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hamilcar/live/session.hpp"
#include "hamilcar/road/tile.hpp"

namespace hamilcar::live {

struct InputMessage {
    std::uint32_t sequence = 0;
    Controls controls;
};
struct ResetMessage {};
struct PauseMessage {
    bool on = false;
};
struct PaceMessage {
    double factor = 1;
};
struct LoadMessage {
    LoadRequest request;
};
struct RecordMessage {
    bool on = false;
};
struct SwitchMessage {
    std::string aid;  // its keyword
    bool on = false;
};
struct TakeMessage {};

using ClientMessage = std::variant<InputMessage, ResetMessage, PauseMessage, PaceMessage, LoadMessage, RecordMessage,
                                   SwitchMessage, TakeMessage>;

// Why a message was refused, for the user.
struct InvalidMessage {
    std::string message;
};

std::variant<ClientMessage, InvalidMessage> read_message(std::string_view text);

// The connections, as reported in a status message.
struct ConnectionStatus {
    std::uint32_t driver = 0;  // number of its page; 0: none
    std::size_t pages = 0;
};

std::string hello_message(std::uint32_t page, const Catalog& catalog);
std::string car_message(const LiveSimulation& simulation);
std::string result_message(const TestCourse& course, const CourseRun& run);
// `switched_off`: keywords of aids.
std::string status_message(const ConnectionStatus& connections, const Progress& progress,
                           const RecordingStatus& recording, const std::vector<std::string>& switched_off,
                           long lost_frames);
std::string refusal_message(std::string_view message);
// Binary messages.
std::string frame_message(std::uint32_t car, const Frame& frame);
std::string tile_message(std::uint32_t car, const RoadTile& tile);

}  // namespace hamilcar::live
