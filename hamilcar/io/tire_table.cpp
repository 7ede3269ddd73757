// One function per model of a `[tire.NAME]` table, in the order of docs/files/tire.md.
#include "hamilcar/io/vehicle_tables.hpp"

#include <fmt/format.h>

#include "hamilcar/base/text.hpp"
#include "hamilcar/io/choices.hpp"
#include "hamilcar/io/shipped.hpp"
#include "hamilcar/io/tir_file.hpp"
#include "hamilcar/tire/list.hpp"

namespace hamilcar::io {

namespace {

TireDescription read_linear_tire(const TableReader& tire) {
    return LinearTireDescription{.radius = tire.number("radius_m", positive),
                                 .rolling_radius = tire.number("rolling_radius_m", positive),
                                 .vertical_stiffness = tire.number("vertical_stiffness_N_per_m", positive),
                                 .vertical_damping = tire.number("vertical_damping_N_s_per_m", not_negative),
                                 .longitudinal_stiffness = tire.number("longitudinal_stiffness_per_load", positive),
                                 .cornering_reference = tire.number("cornering_reference_N_per_rad", positive),
                                 .cornering_load = tire.number("cornering_load_N", positive),
                                 .friction = tire.number("friction", positive),
                                 .relaxation_longitudinal = tire.number("relaxation_longitudinal_m", positive),
                                 .relaxation_lateral = tire.number("relaxation_lateral_m", positive),
                                 .carcass_damping = tire.number("carcass_damping_s", not_negative),
                                 .rolling_resistance = tire.number("rolling_resistance", not_negative)};
}

TireDescription read_spring_tire(const TableReader& tire) {
    return SpringTireDescription{.radius = tire.number("radius_m", positive),
                                 .rolling_radius = tire.number("rolling_radius_m", positive),
                                 .vertical_stiffness = tire.number("vertical_stiffness_N_per_m", positive)};
}

CasingDescription read_casing(const TableReader& tire) {
    return {.radius = tire.number("radius_m", positive),
            .rolling_radius = tire.number("rolling_radius_m", positive),
            .vertical_stiffness = tire.number("vertical_stiffness_N_per_m", positive),
            .vertical_growth = tire.number("vertical_growth_N_per_m2", not_negative, 0),
            .vertical_damping = tire.number("vertical_damping_N_s_per_m", not_negative),
            .carcass_damping = tire.number("carcass_damping_s", not_negative, CasingDescription{}.carcass_damping)};
}

std::optional<double> read_override(const TableReader& tire, std::string_view key) {
    return tire.has(key) ? std::optional(tire.number(key, positive)) : std::nullopt;
}

// Beside the file that names it, or by its name alone among the tires that come with hamilcar.
std::string property_file(const TableReader& tire) {
    const std::string path = tire.path_to_file("file"), name = tire.text("file");
    if (tire.is_recording() || name.find('/') != std::string::npos) return path;
    const auto found = find_tire(path, name);
    std::string known;
    for (const std::string& shipped : shipped_tires()) known += " '" + shipped + "'";
    tire.expect(found.has_value(), "file", "a file that is there (" + path + " is not), or a shipped tire:" + known);
    return *found;
}

TireDescription read_magic_formula(const TableReader& tire) {
    const std::string path = property_file(tire);
    const TirOverrides overrides{.radius = read_override(tire, "radius_m"),
                                 .rolling_radius = read_override(tire, "rolling_radius_m"),
                                 .vertical_stiffness = read_override(tire, "vertical_stiffness_N_per_m"),
                                 .vertical_damping = read_override(tire, "vertical_damping_N_s_per_m"),
                                 .pressure = read_override(tire, "pressure_Pa")};
    MagicFormulaDescription magic = tire.is_recording() ? MagicFormulaDescription{} : read_tir(path, overrides).tire;
    for (const char* key : {"rolling_radius_m", "radius_m"}) {
        if (tire.is_recording() || !tire.has(key)) continue;
        tire.expect(possible_rolling_radius(magic.casing), key,
                    fmt::format("a rolling radius between half the unloaded one and twice it (here {} and {} m)",
                                number_text(magic.casing.rolling_radius), number_text(magic.casing.radius)));
    }
    magic.casing.carcass_damping = tire.number("carcass_damping_s", not_negative, magic.casing.carcass_damping);
    const double friction = tire.number("friction_scale", {"number from 0.01 to 100", 0.01, 100}, 1);
    magic.coefficients[LMUX] *= friction, magic.coefficients[LMUY] *= friction;
    return magic;
}

TmeasyCurve read_curve(const TableReader& curve) {
    const TmeasyCurve out{.stiffness = curve.number("stiffness_N", positive),
                          .peak_slip = curve.number("peak_slip", positive),
                          .peak_force = curve.number("peak_force_N", positive),
                          .sliding_slip = curve.number("sliding_slip", positive),
                          .sliding_force = curve.number("sliding_force_N", positive)};
    curve.expect(out.sliding_slip > out.peak_slip, "sliding_slip", "a number above peak_slip");
    curve.expect(out.sliding_force <= out.peak_force, "sliding_force_N", "a force not above peak_force_N");
    curve.expect(out.stiffness * out.peak_slip >= 2 * out.peak_force, "stiffness_N",
                 "at least twice peak_force_N over peak_slip, so that the curve has its peak there");
    return out;
}

std::array<TmeasyCurve, 2> read_direction(const TableReader& tire, std::string_view key) {
    const TableReader table = tire.table(key);
    return {read_curve(table.table("at_nominal_load")), read_curve(table.table("at_twice_the_load"))};
}

// What is given at two loads is used from next to none up to three times the nominal one: everything must stay above zero
// there, and every curve must have its peak before its sliding.
void check_over_load(const TableReader& tire, const TmeasyDescription& d) {
    if (tire.is_recording()) return;
    const auto holds = [](const std::array<TmeasyCurve, 2>& curves) {
        const TmeasyDirection<double> direction(curves);
        for (const double load : {0.02, 3.0}) {
            const auto at = direction.at(load, 1);
            if (!(at.stiffness > 0 && at.peak_slip > 0 && at.sliding_force > 0 &&
                  at.sliding_slip > 1.001 * at.peak_slip && at.peak_force >= 0.999 * at.sliding_force)) {
                return false;
            }
        }
        return true;
    };
    constexpr const char* expectation =
        "curves that keep stiffness, forces and slips above zero, and the peak before and above the sliding, from 0.02 "
        "to 3 "
        "times nominal_load_N";
    tire.expect(holds(d.longitudinal), "longitudinal", expectation);
    tire.expect(holds(d.lateral), "lateral", expectation);
    for (const double load : {0.02, 3.0}) {
        const double vanishes = AlongLoad<double>(d.trail_vanishes[0], d.trail_vanishes[1])(load);
        const double ends = AlongLoad<double>(d.trail_ends[0], d.trail_ends[1])(load);
        tire.expect(vanishes > 0 && ends > vanishes, "trail",
                    "slips that stay above zero and in order from 0.02 to 3 times nominal_load_N");
    }
}

TireDescription read_tmeasy(const TableReader& tire) {
    const TableReader trail = tire.table("trail");
    TmeasyDescription out{.casing = read_casing(tire),
                          .nominal_load = tire.number("nominal_load_N", positive),
                          .longitudinal = read_direction(tire, "longitudinal"),
                          .lateral = read_direction(tire, "lateral"),
                          .trail = trail.array<2>("over_contact_length"),
                          .trail_vanishes = trail.array<2>("vanishes_at_slip"),
                          .trail_ends = trail.array<2>("ends_at_slip"),
                          .friction = tire.number("friction_scale", positive, 1),
                          .rolling_resistance = tire.number("rolling_resistance", not_negative, 0),
                          .carcass_x = tire.number("carcass_longitudinal_N_per_m", positive),
                          .carcass_y = tire.number("carcass_lateral_N_per_m", positive)};
    check_over_load(tire, out);
    for (std::size_t i = 0; i < 2; ++i) {
        trail.expect(out.trail_vanishes[i] > 0, "vanishes_at_slip", "two positive numbers");
        trail.expect(out.trail_ends[i] > out.trail_vanishes[i], "ends_at_slip",
                     "numbers above those of vanishes_at_slip");
    }
    return out;
}

TireDescription read_fiala(const TableReader& tire) {
    FialaDescription out{.casing = read_casing(tire),
                         .longitudinal_stiffness = tire.number("longitudinal_stiffness_N", positive),
                         .cornering_stiffness = tire.number("cornering_stiffness_N_per_rad", positive),
                         .static_friction = tire.number("static_friction", positive),
                         .sliding_friction = tire.number("sliding_friction", positive),
                         .width = tire.number("width_m", not_negative),
                         .rolling_resistance = tire.number("rolling_resistance", not_negative, 0),
                         .relaxation_x = tire.number("relaxation_longitudinal_m", positive),
                         .relaxation_y = tire.number("relaxation_lateral_m", positive)};
    tire.expect(out.sliding_friction <= out.static_friction, "sliding_friction", "a number not above static_friction");
    return out;
}

TireDescription read_brush(const TableReader& tire) {
    return BrushDescription{.casing = read_casing(tire),
                            .nominal_load = tire.number("nominal_load_N", positive),
                            .longitudinal_stiffness = tire.number("longitudinal_stiffness_N", positive),
                            .cornering_stiffness = tire.number("cornering_stiffness_N_per_rad", positive),
                            .friction = tire.number("friction", positive),
                            .contact_length = tire.number("contact_length_m", positive),
                            .rolling_resistance = tire.number("rolling_resistance", not_negative, 0),
                            .carcass_x = tire.number("carcass_longitudinal_N_per_m", positive),
                            .carcass_y = tire.number("carcass_lateral_N_per_m", positive)};
}

TireDescription read_dugoff(const TableReader& tire) {
    return DugoffDescription{.casing = read_casing(tire),
                             .longitudinal_stiffness = tire.number("longitudinal_stiffness_N", positive),
                             .cornering_stiffness = tire.number("cornering_stiffness_N_per_rad", positive),
                             .friction = tire.number("friction", positive),
                             .rolling_resistance = tire.number("rolling_resistance", not_negative, 0),
                             .relaxation_x = tire.number("relaxation_longitudinal_m", positive),
                             .relaxation_y = tire.number("relaxation_lateral_m", positive)};
}

template <class Model>
constexpr Kind<TireDescription> kind(TireDescription (*read)(const TableReader&)) {
    return {Model::keyword, read};
}
constexpr std::array tire_kinds{kind<LinearTire<double>>(read_linear_tire),
                                kind<SpringTire<double>>(read_spring_tire),
                                kind<MagicFormula<double>>(read_magic_formula),
                                kind<Tmeasy<double>>(read_tmeasy),
                                kind<Fiala<double>>(read_fiala),
                                kind<Brush<double>>(read_brush),
                                kind<Dugoff<double>>(read_dugoff)};

}  // namespace

NamedTires read_tires(const TableReader& file) {
    NamedTires tires;
    for (const auto& [name, table] : file.named_tables("tire")) {
        tires.emplace_back(name, read_kind(tire_kinds, table, "model"));
    }
    file.expect(!tires.empty(), "tire", "at least one [tire.NAME]");
    return tires;
}

const TireDescription& tire_of(const TableReader& axle, const NamedTires& tires) {
    std::vector<std::string_view> names;
    for (const auto& [name, tire] : tires) names.push_back(name);
    return tires[axle.one_of("tire", names)].second;
}

}  // namespace hamilcar::io
