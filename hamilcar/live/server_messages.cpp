#include <algorithm>
#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>

#include "hamilcar/base/units.hpp"
#include "hamilcar/io/column_json.hpp"
#include "hamilcar/live/course_result.hpp"
#include "hamilcar/live/messages.hpp"

namespace hamilcar::live {

namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "frames and tiles are little-endian");

constexpr std::uint32_t frame_kind = 1, tile_kind = 2;

// Names come from users' files, which are not necessarily valid UTF-8.
std::string text_of(const json& message) {
    return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

json choices(const std::vector<Selectable>& list) {
    json out = json::array();
    for (const Selectable& choice : list) {
        out.push_back({{"id", choice.id}, {"name", choice.name}, {"course", choice.course}});
    }
    return out;
}

const char* word(Pause pause) {
    switch (pause) {
        case Pause::driver: return "driver";
        case Pause::no_driver: return "nobody";
        case Pause::ended: return "ended";
        default: return "";
    }
}

// The highest speed at which the unit still has positive torque at full load.
double max_full_load_speed(const PowerUnitDescription& unit) {
    if (const auto* motor = std::get_if<MotorDescription>(&unit.source)) return motor->max_speed;
    const TorqueCurve& full = std::get<EngineDescription>(unit.source).torque.back();
    const auto last = std::ranges::find_if(full.torque.rbegin(), full.torque.rend(), [](double t) { return t > 0; });
    return last == full.torque.rend() ? full.speed.back() : *(full.speed.rbegin() + (last - full.torque.rbegin()));
}

json driveline(const LiveSimulation& simulation) {
    const DrivenCar& car = simulation.car();
    if (!car.powered) return nullptr;
    json units = json::array();
    for (const PowerUnitDescription& unit : simulation.vehicle().power_units) {
        const auto* engine = std::get_if<EngineDescription>(&unit.source);
        units.push_back({{"name", unit.name},
                         {"idle", engine ? engine->idle_speed / hamilcar::units::rpm : 0.0},
                         {"max", max_full_load_speed(unit) / hamilcar::units::rpm}});
    }
    return {{"units", std::move(units)},
            {"gears", car.gears},
            {"reverse", car.has_reverse},
            {"clutch", car.has_clutch},
            {"automatic", car.gearbox.automatic}};
}

json aids_of(const LiveSimulation& simulation) {
    json aids = json::array();
    for (const Aid& aid : simulation.aids()) aids.push_back({{"keyword", aid.keyword}, {"meaning", aid.meaning}});
    return aids;
}

json course_of(const LiveSimulation& simulation) {
    const TestCourse* test = simulation.course();
    if (!test) return nullptr;
    json boundaries = json::array();
    for (const auto& [from, to] : test->course.boundaries) boundaries.push_back({from[0], from[1], to[0], to[1]});
    return {{"id", test->id},           {"name", test->name},          {"title", test->title},
            {"summary", test->summary}, {"cones", test->course.cones}, {"boundaries", std::move(boundaries)},
            {"line", test->course.line}};
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

std::string hello_message(std::uint32_t page, const Catalog& catalog) {
    return text_of({{"type", "hello"},
                    {"generator", "Hamilcar " HAMILCAR_VERSION},
                    {"page", page},
                    {"vehicles", choices(catalog.vehicles)},
                    {"roads", choices(catalog.roads)}});
}

std::string car_message(const LiveSimulation& simulation) {
    json channels = json::array();
    for (const Channel& channel : simulation.channels()) channels.push_back(io::column_json(channel.column));
    std::string text = text_of({{"type", "car"},
                                {"car", simulation.number()},
                                {"vehicle", simulation.request().vehicle},
                                {"road", simulation.request().road},
                                {"friction", simulation.request().friction},
                                {"steering_lock_deg", simulation.car().lock * 180 / std::numbers::pi},
                                {"gravity_m_per_s2", simulation.vehicle().gravity},
                                {"channels", std::move(channels)},
                                {"driveline", driveline(simulation)},
                                {"aids", aids_of(simulation)},
                                {"course", course_of(simulation)}});
    text.back() = ',';  // the scene is JSON already
    return text + "\"scene\":" + simulation.scene() + "}";
}

// Unknown values are NaN, which is written as null.
std::string result_message(const TestCourse& course, const CourseRun& run) {
    const CourseResult result = course_result(course.course, run);
    json values = json::array(), verdicts = json::array();
    for (const Figure& figure : result.values) {
        values.push_back(
            {{"name", figure.name}, {"unit", figure.unit}, {"value", figure.value}, {"meaning", figure.meaning}});
    }
    const auto judged = [](std::optional<bool> passed) { return passed ? json(*passed) : json(); };
    for (const CourseVerdict& verdict : result.verdicts) {
        verdicts.push_back(
            {{"criterion", verdict.criterion}, {"passed", judged(verdict.passed)}, {"found", verdict.found}});
    }
    return text_of({{"type", "result"},
                    {"course", course.id},
                    {"finished", result.finished},
                    {"passed", judged(result.passed)},
                    {"values", std::move(values)},
                    {"verdicts", std::move(verdicts)},
                    {"time", result.time}});
}

std::string status_message(const ConnectionStatus& connections, const Progress& progress,
                           const RecordingStatus& recording, const std::vector<std::string>& switched_off,
                           long lost_frames) {
    const PaceReport& report = progress.report;
    return text_of({{"type", "status"},
                    {"driver", connections.driver},
                    {"pages", connections.pages},
                    {"paused", word(progress.paused)},
                    {"ended", progress.ended},
                    {"pace", progress.pace},
                    {"time", progress.time},
                    {"switched_off", switched_off},
                    {"steps", report.steps},
                    {"step_ms", 1e3 * progress.step},
                    {"period_ms", 1e3 * report.period},
                    {"compute_us", 1e6 * report.compute},
                    {"worst_overrun_ms", 1e3 * report.worst_delay},
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
