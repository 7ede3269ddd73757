// `hamilcar road SCENARIO`: what a scenario's road is like, track by track, and the road as an OpenCRG file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands.hpp"
#include "files.hpp"
#include "hamilcar/io/crg_file.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/scenario_file.hpp"
#include "hamilcar/road/plane.hpp"
#include "hamilcar/road/road_spectrum.hpp"
#include "hamilcar/road/surface.hpp"

namespace hamilcar::cli {

namespace {

struct RoadOptions {
    std::string scenario, output;
    double length = 400;  // from x = 0 on [m]
    bool json = false;
};

// Heights of a scenario's road, plane and all [m].
class Ground {
public:
    explicit Ground(const RoadDescription& road)
        : normal_(PlaneRoad<double>(road.grade, road.bank, 1).normal), surface_(road) {}
    double height(double x, double y) const {
        return surface_.height(x, y) - (normal_[0] * x + normal_[1] * y) / normal_[2];
    }

private:
    Vec3<double> normal_;
    Surface surface_;
};

struct Track {
    double y, lowest, highest;           // [m]
    std::optional<Roughness> roughness;  // none of a straight line, or of a profile too short to tell
};

// Largest distance from the straight line between the ends [m].
double unevenness(const std::vector<double>& profile) {
    const double rise = (profile.back() - profile.front()) / static_cast<double>(profile.size() - 1);
    double largest = 0;
    for (std::size_t i = 0; i < profile.size(); ++i) {
        largest = std::max(largest, std::abs(profile[i] - profile.front() - rise * static_cast<double>(i)));
    }
    return largest;
}

std::optional<Roughness> roughness_of(const std::vector<double>& profile, double step) {
    constexpr double round_off = 1e-6;  // a tenth of a hair; the smoothest class moves by millimeters [m]
    if (unevenness(profile) < round_off) return {};
    std::size_t segment = 4;  // half the profile or less, in the longest power of two
    while (4 * segment <= profile.size()) segment *= 2;
    const std::vector<Band> bands = smoothed(spectrum(profile, step, segment));
    if (std::ranges::count_if(bands, [](const Band& band) { return band.density > 0; }) < 2) return {};
    return fitted(bands);
}

Track track_at(const Ground& ground, double y, double length, double step) {
    std::vector<double> profile;
    for (double x = 0; x <= length; x += step) profile.push_back(ground.height(x, y));
    const auto [low, high] = std::minmax_element(profile.begin(), profile.end());
    return {y, *low, *high, roughness_of(profile, step)};
}

CrgDescription as_crg(const Ground& ground, double length, double step, double half_width) {
    CrgDescription crg;
    crg.u_increment = step;
    for (double v = -half_width; v <= half_width + 1e-9; v += 0.1) crg.v.push_back(v);
    const auto rows = static_cast<std::size_t>(std::lround(length / step)) + 1;
    for (std::size_t i = 0; i < rows; ++i) {
        for (const double v : crg.v) crg.heights.push_back(ground.height(step * static_cast<double>(i), v));
    }
    return crg;
}

nlohmann::json json_of(const Track& track) {
    nlohmann::json out{{"y_m", track.y},          {"lowest_m", track.lowest}, {"highest_m", track.highest},
                       {"roughness_m3", nullptr}, {"waviness", nullptr},      {"iso_8608_class", nullptr}};
    if (track.roughness) {
        out["roughness_m3"] = track.roughness->at_reference, out["waviness"] = track.roughness->waviness;
        out["iso_8608_class"] = std::string(1, class_of(track.roughness->at_reference));
    }
    return out;
}

void print(const Track& track) {
    fmt::print("  y = {:+.2f} m: heights {:.3f} to {:.3f} m", track.y, track.lowest, track.highest);
    if (!track.roughness) {
        fmt::print(", even\n");
    } else {
        fmt::print(", Gd(0.1/m) = {:.3g}e-6 m^3, waviness {:.2f}: ISO 8608 class {}\n",
                   1e6 * track.roughness->at_reference, track.roughness->waviness,
                   class_of(track.roughness->at_reference));
    }
}

io::ExitCode road(const RoadOptions& options) {
    constexpr double step = 0.05, half_width = 3, half_track = 0.75;  // [m]
    const ScenarioDescription scenario = io::read_scenario(options.scenario);
    const Ground ground(scenario.road);
    std::vector<Track> tracks;
    for (const double y : {half_track, -half_track}) tracks.push_back(track_at(ground, y, options.length, step));
    if (options.json) {
        nlohmann::json all = nlohmann::json::array();
        for (const Track& track : tracks) all.push_back(json_of(track));
        fmt::print("{}\n", io::json_text(nlohmann::json{
                               {"file", options.scenario}, {"length_m", options.length}, {"tracks", all}}));
    } else {
        fmt::print("{}: the road from x = 0 to {:g} m\n", options.scenario, options.length);
        for (const Track& track : tracks) print(track);
    }
    if (!options.output.empty()) {
        io::write_crg(as_crg(ground, options.length, step, half_width), options.output, io::CrgFormat::binary_double);
        tell_written(options.json, fmt::format("{:g} m of road, {:g} m wide, as OpenCRG to {}", options.length,
                                               2 * half_width, options.output));
    }
    return io::ExitCode::ok;
}

}  // namespace

void add_road(CommandList& list) {
    auto [command, o] =
        list.add<RoadOptions>("road", "show how rough a scenario's road is, or write it as an OpenCRG file", road);
    command.add("scenario", o.scenario, "scenario file (TOML)").required();
    command.add("--length", o.length, {10, 20000, "m"}, "of road, from x = 0 on");
    command.add("-o,--output", o.output, "OpenCRG file (.crg) to write");
    command.add_json(o.json);
}

}  // namespace hamilcar::cli
