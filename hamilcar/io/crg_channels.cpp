#include "hamilcar/io/crg_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/base/text.hpp"

namespace hamilcar::io::crg {

namespace {

// A longitudinal section: its number or its place.
struct Cut {
    double at;
    std::size_t channel;
};

struct Cuts {
    std::vector<Cut> numbered, placed;
};

// The channels of the reference line, and the longitudinal sections as the file lists them.
Cuts sort_out(const Header& header, Channels& found) {
    Cuts cuts;
    for (std::size_t i = 0; i < header.channels().size(); ++i) {
        const Channel& channel = header.channels()[i];
        const std::string& name = channel.name;
        const auto fail = [&](const std::string& expected) { header.fail(channel.line, "d:" + name, expected); };
        const auto demand_unit = [&](const char* wanted) {
            if (channel.unit != wanted) fail(fmt::format("the unit {}, not '{}'", wanted, channel.unit));
        };
        const auto take = [&](const char* called, const char* unit, std::optional<std::size_t>& place) {
            if (name != called) return;
            demand_unit(unit);
            if (place) fail("the channel once");
            place = i;
        };
        take("reference line u", "m", found.u);
        take("reference line phi", "rad", found.phi);
        take("reference line slope", "m/m", found.slope);
        take("reference line banking", "m/m", found.banking);
        if (name == "reference line x" || name == "reference line y")
            fail("the reference line by its phi; channels of x and y are not supported");
        constexpr std::string_view section = "long section ", at = "at v =";
        if (!name.starts_with(section)) continue;
        demand_unit("m");
        const std::string_view where = std::string_view(name).substr(section.size());
        const bool by_position = where.starts_with(at);
        const std::optional<double> read = number_in(by_position ? where.substr(at.size()) : where);
        if (!read || !(std::abs(*read) <= max_distance))
            header.fail(channel.line, "d:" + name, "long section NUMBER or long section at v = NUMBER");
        (by_position ? cuts.placed : cuts.numbered).push_back({*read, i});
    }
    return cuts;
}

}  // namespace

Channels find_channels(const Header& header, CrgDescription& road) {
    Channels found;
    auto [numbered, placed] = sort_out(header, found);
    std::vector<Cut>& cuts = placed.empty() ? numbered : placed;
    const int section_line = header.definition_line();
    if (!placed.empty() && !numbered.empty())
        header.fail(section_line, "d:long section", "all sections by number or all by v");
    if (cuts.size() < 2) header.fail(section_line, "d:long section", "two sections at least");
    std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.at < b.at; });

    const double step = header.number(road_section, "long_section_v_increment", 0.01, min_step, max_step);
    // The specification leaves the default open; OpenCRG's library takes zero, its MATLAB tools center the road.
    const double right = header.number(road_section, "long_section_v_right", 0, -max_distance, max_distance);
    if (placed.empty() && !header.has(road_section, "long_section_v_right"))
        road.remarks.push_back(header.remark(section_line, "long_section_v_right",
                                             "is missing: the first section lies on the reference line"));
    for (std::size_t j = 0; j < cuts.size(); ++j) {
        const Channel& channel = header.channels()[cuts[j].channel];
        const auto count = static_cast<double>(j);
        if (placed.empty() && std::abs(cuts[j].at - count - 1) > 1e-3)
            header.fail(channel.line, "d:" + channel.name, fmt::format("each number from 1 to {} once", cuts.size()));
        found.v.push_back(placed.empty() ? right + count * step : cuts[j].at);
        if (j > 0 && !(found.v[j] - found.v[j - 1] >= min_step))
            header.fail(channel.line, "d:" + channel.name, fmt::format("sections {:g} m apart at least", min_step));
        found.sections.push_back(cuts[j].channel);
    }
    const double left = header.number(road_section, "long_section_v_left", found.v.back(), -max_distance, max_distance);
    if (placed.empty() && std::abs(left - found.v.back()) > 1e-3 + 0.1 * step)
        road.remarks.push_back(
            header.remark(header.line_of(road_section, "long_section_v_left"), "long_section_v_left",
                          fmt::format("is not used: {} sections end at {:g}", cuts.size(), found.v.back())));
    if (!(std::abs(found.v.back()) <= max_distance))
        header.fail(section_line, "d:long section",
                    fmt::format("a road within {:g} m of its reference line", max_distance));
    road.v = found.v;
    return found;
}

}  // namespace hamilcar::io::crg
