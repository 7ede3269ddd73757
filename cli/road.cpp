// `hamilcar road SCENARIO`: what a scenario's road is like, track by track, and the road as an OpenCRG file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands.hpp"
#include "hamilcar/io/crg_file.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/road/plane.hpp"
#include "hamilcar/road/road_spectrum.hpp"
#include "hamilcar/road/surface.hpp"

namespace hamilcar::cli {

namespace {

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

}  // namespace

io::ExitCode road(const Options& options) {
    constexpr double step = 0.05, half_width = 3, half_track = 0.75;  // [m]
    const ScenarioDescription scenario = io::read_scenario(options.file);
    const Ground ground(scenario.road);
    nlohmann::json tracks = nlohmann::json::array();
    for (const double y : {half_track, -half_track}) {
        const Track track = track_at(ground, y, options.length, step);
        nlohmann::json facts{{"y_m", y},
                             {"lowest_m", track.lowest},
                             {"highest_m", track.highest},
                             {"roughness_m3", nullptr},
                             {"waviness", nullptr},
                             {"iso_8608_class", nullptr}};
        if (track.roughness) {
            facts["roughness_m3"] = track.roughness->at_reference, facts["waviness"] = track.roughness->waviness;
            facts["iso_8608_class"] = std::string(1, class_of(track.roughness->at_reference));
        }
        tracks.push_back(std::move(facts));
    }
    if (options.json) {
        fmt::print("{}\n", io::json_text(nlohmann::json{
                               {"file", options.file}, {"length_m", options.length}, {"tracks", tracks}}));
    } else {
        fmt::print("{}: the road from x = 0 to {:g} m\n", options.file, options.length);
        for (const auto& track : tracks) {
            fmt::print("  y = {:+.2f} m: heights {:.3f} to {:.3f} m", track["y_m"].get<double>(),
                       track["lowest_m"].get<double>(), track["highest_m"].get<double>());
            if (track["roughness_m3"].is_null()) {
                fmt::print(", even\n");
            } else {
                fmt::print(", Gd(0.1/m) = {:.3g}e-6 m^3, waviness {:.2f}: ISO 8608 class {}\n",
                           1e6 * track["roughness_m3"].get<double>(), track["waviness"].get<double>(),
                           track["iso_8608_class"].get<std::string>());
            }
        }
    }
    if (!options.output.empty()) {
        io::write_crg(as_crg(ground, options.length, step, half_width), options.output, io::CrgFormat::binary_double);
        fmt::print(stderr, "wrote {:g} m of road, {:g} m wide, as OpenCRG to {}\n", options.length, 2 * half_width,
                   options.output);
    }
    return io::ExitCode::ok;
}

}  // namespace hamilcar::cli
