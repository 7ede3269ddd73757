// One function per element, in the order of docs/files/scenario.md.
#include "hamilcar/io/road_file.hpp"

#include <fmt/format.h>

#include <cmath>

#include "hamilcar/io/choices.hpp"
#include "hamilcar/io/column_file.hpp"
#include "hamilcar/io/crg_file.hpp"
#include "hamilcar/io/grid_file.hpp"

namespace hamilcar::io {

namespace {

// From right to left; everywhere where the file says nothing.
void read_breadth(const TableReader& table, double& right, double& left) {
    right = table.number("right_m", any_number, -everywhere);
    left = table.number("left_m", any_number, everywhere);
    table.expect(right < left, "left_m", "a number above right_m");
}

ObstacleDescription read_obstacle(const TableReader& table) {
    const ObstacleDescription defaults;
    ObstacleDescription out;
    out.shape =
        word<ObstacleShape>(table, "shape", {{"plateau", ObstacleShape::plateau}, {"hump", ObstacleShape::hump}});
    out.start = table.number("start_m", any_number);
    out.length = table.number("length_m", positive);
    out.height = table.number("height_m", any_number);
    out.ramp = table.number("ramp_m", positive, defaults.ramp);
    read_breadth(table, out.right, out.left);
    out.side_ramp = table.number("side_ramp_m", positive, defaults.side_ramp);
    constexpr Range whole{.words = "whole number from 1 to 10000", .min = 1, .max = 10000, .is_whole = true};
    out.count = static_cast<int>(table.number("count", whole, defaults.count));
    out.repeat_every = table.number("repeat_every_m", not_negative, defaults.repeat_every);
    table.expect(out.count == 1 || out.repeat_every >= out.length, "repeat_every_m", "at least length_m");
    return out;
}

// Every height of the road asks each entry, and what is random is computed before a run.
constexpr std::size_t most_entries = 1000;  // of one kind
constexpr int most_nodes = 1 << 22;         // of one random road, along each track

WaveDescription read_wave(const TableReader& table) {
    WaveDescription out;
    out.start = table.number("start_m", any_number, 0);
    out.length = table.number("length_m", not_negative, 0);
    out.amplitude = table.number("amplitude_m", not_negative);
    out.wavelength = table.number("wavelength_m", positive);
    out.last_wavelength = table.number("last_wavelength_m", positive, out.wavelength);
    out.right_phase = table.number("right_phase_deg", any_number, 0);
    table.expect(out.length > 0 || out.last_wavelength == out.wavelength, "last_wavelength_m",
                 "a length_m beside it: an endless wave has one wavelength");
    return out;
}

RandomRoadDescription read_random(const TableReader& table) {
    constexpr std::array<std::string_view, 8> classes{"A", "B", "C", "D", "E", "F", "G", "H"};
    const RandomRoadDescription defaults;
    RandomRoadDescription out;
    out.road_class = classes[table.one_of("class", classes)][0];
    constexpr Range whole{.words = "whole number from 0 to 1e15", .min = 0, .max = 1e15, .is_whole = true};
    out.seed = static_cast<std::uint64_t>(table.number("seed", whole, 1));
    out.start = table.number("start_m", any_number, defaults.start);
    out.length = table.number("length_m", not_negative, defaults.length);
    out.track_width = table.number("track_width_m", positive, defaults.track_width);
    out.fade = table.number("fade_m", positive, defaults.fade);
    out.spacing = table.number("spacing_m", {"number from 0.001 to 0.1", 0.001, 0.1}, defaults.spacing);
    table.expect(table.is_recording() || out.length / out.spacing <= most_nodes, "length_m",
                 "at most 4 million times spacing_m, 200 km at the default one");
    return out;
}

FrictionPatchDescription read_patch(const TableReader& table) {
    FrictionPatchDescription out;
    out.start = table.number("start_m", any_number, -everywhere);
    out.end = table.number("end_m", any_number, everywhere);
    table.expect(out.start < out.end, "end_m", "a number above start_m");
    read_breadth(table, out.right, out.left);
    out.friction = table.number("friction", positive);
    out.ramp = table.number("ramp_m", positive, out.ramp);
    return out;
}

// A list of numbers at `key`, and the times; a single number holds always.
Samples read_written_signal(const TableReader& table, std::string_view key, const Range& range) {
    Samples out;
    table.choose_list(key, [&](bool is_list) {
        if (is_list) out = table.samples("time_s", key, range);
        if (is_list) return;
        table.choose_presence("time_s", [&](bool has_times) {
            out = has_times ? table.samples("time_s", key, range) : Samples{{0}, {table.number(key, range)}};
        });
    });
    return out;
}

// A column of a file, and that of the times.
Samples read_signal_file(const TableReader& table, std::string_view key, const Range& range) {
    const std::string path = table.path_to_file("file"), column = table.text("column");
    const std::string time = table.has("time_column") ? table.text("time_column") : "time";
    if (table.is_recording()) return {};
    return parse_columns(read_named_file(table, "file"), path, {time, column, "time_s", key, range});
}

PostsDescription read_posts(const TableReader& table) {
    PostsDescription out;
    for (const TableReader& post : table.tables("wheel"))
        out.height.push_back(read_signal(post, "height_m", any_number));
    return out;
}

}  // namespace

SignalDescription read_signal(const TableReader& table, std::string_view key, const Range& range) {
    const auto interpolation = word<Interpolation>(
        table, "interpolation",
        {{"smooth", Interpolation::smooth}, {"smoother", Interpolation::smoother}, {"linear", Interpolation::linear}});
    Samples samples;
    table.choose({{key}, {"file"}}, [&](std::size_t group) {
        samples = (group == 1 ? read_signal_file : read_written_signal)(table, key, range);
    });
    return {samples.argument, samples.value, interpolation};
}

RoadDescription read_road(const TableReader& table) {
    RoadDescription road;
    constexpr Range slope{"number from -1000 to 1000", -1000, 1000};  // [%]
    road.grade = table.number("grade_percent", slope, 0);
    road.bank = table.number("bank_percent", slope, 0);
    road.friction = table.number("friction", positive, 1);
    const auto each = [&table](std::string_view key, auto read, auto& to) {
        if (!table.has(key)) return;
        for (const TableReader& one : table.tables(key)) to.push_back(read(one));
        table.expect(to.size() <= most_entries, key, fmt::format("at most {} of them", most_entries));
    };
    each("obstacle", read_obstacle, road.obstacles);
    each("wave", read_wave, road.waves);
    each("random", read_random, road.random);
    each("friction_patch", read_patch, road.patches);
    double nodes = 0;
    for (const RandomRoadDescription& one : road.random) nodes += one.length / one.spacing;
    table.expect(table.is_recording() || nodes <= 2 * most_nodes, "random",
                 "all of them together at most 8 million times their spacing_m long");
    for (std::size_t i = 0; i < road.random.size(); ++i) road.random[i].stream = static_cast<std::uint32_t>(i);
    if (table.has("crg_file")) {
        const std::string path = table.path_to_file("crg_file");
        if (!table.is_recording()) road.crg = std::make_shared<const CrgDescription>(read_crg(path));
    }
    if (table.has("grid_file")) {
        const std::string path = table.path_to_file("grid_file");
        if (!table.is_recording()) road.grid = std::make_shared<const HeightGridDescription>(read_grid(path));
    }
    if (const auto posts = table.optional_table("posts")) road.posts = read_posts(*posts);
    return road;
}

}  // namespace hamilcar::io
