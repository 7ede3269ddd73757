#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>

#include "hamilcar/live/messages.hpp"

namespace hamilcar::live {

namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "frames and tiles are little-endian");

constexpr std::uint32_t frame_kind = 1, tile_kind = 2;

// Names come from people's files, which need not be UTF-8 throughout.
std::string text_of(const json& message) {
    return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

json choices(const std::vector<Choice>& list) {
    json out = json::array();
    for (const Choice& choice : list) out.push_back({{"id", choice.id}, {"name", choice.name}});
    return out;
}

const char* word(Pause pause) {
    switch (pause) {
        case Pause::driver: return "driver";
        case Pause::nobody: return "nobody";
        case Pause::ended: return "ended";
        default: return "";
    }
}

class Bytes {
public:
    explicit Bytes(std::size_t size) { text_.reserve(size); }
    template <class... T>
    Bytes& add(const T&... numbers) {
        (text_.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
        return *this;
    }
    Bytes& add(const std::vector<float>& numbers) {
        text_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float));
        return *this;
    }
    std::string take() { return std::move(text_); }

private:
    std::string text_;
};

}  // namespace

std::string hello_message(std::uint32_t page, const Garage& garage) {
    return text_of({{"type", "hello"},
                    {"generator", "Hamilcar " HAMILCAR_VERSION},
                    {"page", page},
                    {"vehicles", choices(garage.vehicles)},
                    {"roads", choices(garage.roads)}});
}

std::string car_message(const Ride& ride) {
    json channels = json::array();
    for (const Channel& channel : ride.channels()) {
        channels.push_back({{"name", channel.column.name},
                            {"unit", channel.column.unit},
                            {"description", channel.column.description}});
    }
    std::string text = text_of({{"type", "car"},
                                {"car", ride.number()},
                                {"vehicle", ride.wish().vehicle},
                                {"road", ride.wish().road},
                                {"friction", ride.wish().friction},
                                {"steering_lock_deg", ride.lock() * 180 / std::numbers::pi},
                                {"channels", std::move(channels)}});
    text.back() = ',';  // the scene is JSON already
    return text + "\"scene\":" + ride.scene() + "}";
}

std::string status_message(const Attendance& attendance, const Progress& progress, const RecordingStatus& recording,
                           long lost_frames) {
    const PaceReport& report = progress.report;
    return text_of({{"type", "status"},
                    {"driver", attendance.driver},
                    {"pages", attendance.pages},
                    {"paused", word(progress.paused)},
                    {"ended", progress.ended},
                    {"pace", progress.pace},
                    {"time", progress.time},
                    {"steps", report.steps},
                    {"step_ms", 1e3 * progress.step},
                    {"period_ms", 1e3 * report.period},
                    {"compute_us", 1e6 * report.compute},
                    {"worst_overrun_ms", 1e3 * report.worst},
                    {"overruns", report.overruns},
                    {"recording", recording.file},
                    {"recorded_s", recording.seconds},
                    {"lost_rows", recording.lost_rows},
                    {"lost_frames", lost_frames}});
}

std::string refusal_message(std::string_view message) {
    return text_of({{"type", "refusal"}, {"message", message}});
}

std::string frame_message(std::uint32_t car, const Frame& frame) {
    return Bytes(24 + 4 * frame.values.size())
        .add(frame_kind, car, frame.time, frame.sequence, frame.page)
        .add(frame.values)
        .take();
}

std::string tile_message(std::uint32_t car, const RoadTile& tile) {
    return Bytes(16 + 4 * tile.heights.size())
        .add(tile_kind, car, std::int32_t{tile.ix}, std::int32_t{tile.iy})
        .add(tile.heights)
        .take();
}

}  // namespace hamilcar::live
