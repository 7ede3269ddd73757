// What passes between the page and the server, as text and bytes. The page's side is web/src/live/protocol.ts; the two change
// together.
//
// What a page says is taken at its word only if it is a flat object with exactly the fields of its type, each of its kind and
// within its range. Whatever else may come over a socket is answered, never trusted.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

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
    Wish wish;
};
struct RecordMessage {
    bool on = false;
};
struct TakeMessage {};

using ClientMessage =
    std::variant<InputMessage, ResetMessage, PauseMessage, PaceMessage, LoadMessage, RecordMessage, TakeMessage>;

// What was not understood, for a person.
struct Misunderstanding {
    std::string message;
};

std::variant<ClientMessage, Misunderstanding> read_message(std::string_view text);

// Who is there, as a status tells it.
struct Attendance {
    std::uint32_t driver = 0;  // page; 0: none
    std::size_t pages = 0;
};

std::string hello_message(std::uint32_t page, const Garage& garage);
std::string car_message(const Ride& ride);
std::string result_message(const TestCourse& course, const CourseRun& run);
std::string status_message(const Attendance& attendance, const Progress& progress, const RecordingStatus& recording,
                           long lost_frames);
std::string refusal_message(std::string_view message);
// Bytes.
std::string frame_message(std::uint32_t car, const Frame& frame);
std::string tile_message(std::uint32_t car, const RoadTile& tile);

}  // namespace hamilcar::live
