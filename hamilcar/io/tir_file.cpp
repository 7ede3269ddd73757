// Section by section in the order that MF-Tyre writes them.
#include "hamilcar/io/tir_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hamilcar/base/text.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/property_units.hpp"
#include "hamilcar/io/tir_entries.hpp"
#include "hamilcar/io/tir_keys.hpp"
#include "hamilcar/io/tir_limits.hpp"
#include "hamilcar/tire/mirrored.hpp"

namespace hamilcar::io {

namespace {

// What FITTYP says of the equations.
struct Fit {
    int number;
    std::string_view name;
    bool angle_slip, camber_by_stiffness, upright_aligning_force;
};
constexpr std::array fits{Fit{5, "MF-Tyre 5.0", true, false, false},  Fit{6, "MF-Tyre 5.2", true, false, false},
                          Fit{21, "MF-Tyre 5.2", true, false, false}, Fit{60, "MF-Tyre 6.0", false, true, false},
                          Fit{61, "MF-Tyre 6.1", false, true, true},  Fit{62, "MF-Tyre 6.2", false, true, true}};

class TirReader : TirEntries {
public:
    TirReader(const PropertyFile& file, const TirOverrides& overrides)
        : TirEntries(file), overrides_(overrides), units_(units_of(file)) {}

    TirFile read() {
        for (const PropertyNote& left_out : file_.notes) note(left_out.line, left_out.text);
        for (const std::string_view absent : units_.absent) note(0, fmt::format("no {} in [UNITS]: SI", absent));
        read_model();
        read_casing();
        read_ranges();
        read_coefficients();
        choose_relaxation();
        choose_rolling_radius();
        apply_use_mode();
        apply_side();
        list_the_rest();
        tire().remarks = notes();
        tire().name = file_.path;
        return out_;
    }

private:
    static constexpr std::string_view curve_section = "DEFLECTION_LOAD_CURVE";

    MagicFormulaDescription& tire() { return out_.tire; }

    void read_model() {
        const PropertyEntry* format = find("PROPERTY_FILE_FORMAT");
        const std::string written = format ? format->text : "";
        const PropertyEntry* fittyp = find("FITTYP");
        int fit_number = written == "MF_05" ? 5 : 6;
        if (fittyp && fittyp->number) {
            fit_number = static_cast<int>(std::clamp(*fittyp->number, -1.0, 1e6));
            if (fit_number != *fittyp->number) fit_number = -1;
        } else if (fittyp) {
            fail(fittyp->line, fmt::format("key 'FITTYP' = {}: expected a number", quoted_text(fittyp->text)));
        } else {
            note(0, fmt::format("no 'FITTYP': taken as {}", fit_number));
        }
        const bool motorcycle = fit_number == 51 || fit_number == 52;
        const int newest = fits.back().number;
        if (motorcycle && !find("PCY2")) {
            note(fittyp->line,
                 fmt::format("FITTYP {} is of motorcycle tires, whose PCY2 is not there: taken as 6, a car's "
                             "MF-Tyre 5.2",
                             fit_number));
            fit_number = 6;
        } else if (fit_number > newest && fit_number < 100) {
            note(fittyp->line, fmt::format("FITTYP {} is newer than what is known: taken as {}", fit_number, newest));
            fit_number = newest;
        }
        const auto fit = std::ranges::find(fits, fit_number, &Fit::number);
        if (fit == fits.end()) {
            std::string known;
            for (const Fit& one : fits) known += fmt::format("{}{}", known.empty() ? "" : ", ", one.number);
            fail(fittyp->line, fmt::format("key 'FITTYP' = {}: expected one of {}{}", quoted_text(fittyp->text), known,
                                           motorcycle ? " (51 and 52 are motorcycle tires, and PCY2 is there)" : ""));
        }
        const std::string_view dialect =
            written == "PAC2002" || written == "MF_05" ? std::string_view(written) : fit->name;
        out_.format = fmt::format("{} (FITTYP {})", dialect, fit_number);
        tire().angle_slip = fit->angle_slip;
        tire().camber_by_stiffness = fit->camber_by_stiffness;
        tire().upright_aligning_force = fit->upright_aligning_force;
        tire().nominal_speed = number("LONGVL", tire().nominal_speed, units_.velocity());
        if (!(tire().nominal_speed >= min_in_tir)) fail(line_of("LONGVL"), "key 'LONGVL': expected a positive speed");
    }

    // Fz = stiffness d + growth d^2, with the inflation pressure that the vehicle or the file says.
    void read_casing() {
        CasingDescription& casing = tire().casing;
        tire().nominal_load = positive("FNOMIN", units_.force);
        casing.radius = tire().nominal_radius = positive("UNLOADED_RADIUS", units_.length);
        const double change = read_pressure();
        const double stiffer = (1 + optional("PFZ1").value_or(0) * change) * optional("LCZ").value_or(1);
        const double load = tire().nominal_load, radius = casing.radius, square = either("Q_FZ2", "QFZ2").value_or(0);
        casing.vertical_growth = load * square / (radius * radius) * stiffer;
        std::string_view spring = "VERTICAL_STIFFNESS";
        if (const auto linear = either("Q_FZ1", "QFZ1")) {
            casing.vertical_stiffness = load * *linear / radius * stiffer;
            spring = find("Q_FZ1") ? "Q_FZ1" : "QFZ1";
        } else {
            spring = read_spring(casing, square, stiffer);
        }
        if (!(casing.vertical_stiffness >= min_in_tir && casing.vertical_stiffness <= max_in_tir)) {
            fail(line_of(spring),
                 fmt::format("key '{}': makes, with QFZ2, PFZ1, LCZ and the pressure, a vertical stiffness of "
                             "{:g}; expected a positive one [N/m]",
                             spring, casing.vertical_stiffness));
        }
        casing.vertical_damping = number("VERTICAL_DAMPING", 50, units_.damping());
        if (overrides_.radius) casing.radius = *overrides_.radius;
        if (overrides_.vertical_damping) casing.vertical_damping = *overrides_.vertical_damping;
        if (overrides_.vertical_stiffness) {
            casing.vertical_stiffness = *overrides_.vertical_stiffness, casing.vertical_growth = 0;
        }
    }

    // By VERTICAL_STIFFNESS, the one at the nominal load; without, by what else tells how far the tire deflects. Returns the key.
    std::string_view read_spring(CasingDescription& casing, double square, double stiffer) {
        const double load = tire().nominal_load, radius = casing.radius;
        const auto told = optional("VERTICAL_STIFFNESS", units_.stiffness());
        const auto by_stiffness = [&](double stiffness) {
            const double ratio = stiffness * radius / load;
            casing.vertical_stiffness = load / radius * std::sqrt(std::max(ratio * ratio - 4 * square, 0.0)) * stiffer;
        };
        if (told && *told >= min_in_tir) {
            by_stiffness(*told);
            return "VERTICAL_STIFFNESS";
        }
        const std::string missing = told ? "VERTICAL_STIFFNESS is not positive" : "no VERTICAL_STIFFNESS";
        const auto loaded = optional("LOADED_RADIUS", units_.length);
        const PropertySection* curve = file_.find(curve_section);
        if (overrides_.vertical_stiffness) {
            casing.vertical_stiffness = *overrides_.vertical_stiffness;
        } else if (const auto spring = spring_through(curve, units_.length, units_.force)) {
            use_table(curve);
            casing.vertical_stiffness = (*spring)[0] * stiffer, casing.vertical_growth = (*spring)[1] * stiffer;
            note(curve->table_line, fmt::format("{}: taken from [{}], {:g} N/m and {:g} N/m^2", missing, curve_section,
                                                (*spring)[0], (*spring)[1]));
        } else if (loaded && *loaded > 0 && *loaded < radius) {
            by_stiffness(load / (radius - *loaded));
            note(line_of("LOADED_RADIUS"),
                 fmt::format("{}: taken from LOADED_RADIUS at FNOMIN, {:g} N/m", missing, load / (radius - *loaded)));
        } else {
            positive("VERTICAL_STIFFNESS", units_.stiffness());
        }
        return "VERTICAL_STIFFNESS";
    }

    // The relative change against the nominal pressure.
    double read_pressure() {
        const auto nominal = either("NOMPRES", "IP_NOM", units_.pressure);
        auto own = either("INFLPRES", "IP", units_.pressure);
        if (overrides_.pressure) own = overrides_.pressure;
        if (!nominal || !(*nominal >= min_in_tir)) {
            if (overrides_.pressure)
                fail(line_of("NOMPRES"),
                     "no NOMPRES: a set without one knows no effect of inflation pressure, expected no pressure_Pa in "
                     "the vehicle's file");
            note(0, "no NOMPRES: inflation pressure has no effect");
            return 0;
        }
        const PropertySection* units = file_.find("UNITS");
        if (!units || std::ranges::find(units->entries, "PRESSURE", &PropertyEntry::key) == units->entries.end()) {
            note(line_of("NOMPRES"), "no PRESSURE in [UNITS]: Pa");
        }
        if (!own) note(line_of("NOMPRES"), "no INFLPRES: taken as NOMPRES");
        tire().nominal_pressure = *nominal, tire().pressure = own.value_or(*nominal);
        const double change = (tire().pressure - *nominal) / *nominal;
        if (!(std::abs(change) < 0.9)) {
            fail(line_of("NOMPRES"),
                 fmt::format("inflation pressure {:g} Pa: expected within a tenth and 1.9 times NOMPRES, {:g} Pa",
                             tire().pressure, *nominal));
        }
        return change;
    }

    // A pair of limits; the model's own where the file has none, or has what contradicts itself.
    void range(std::array<double, 2>& limits, std::string_view min, std::string_view max, double unit,
               bool about_zero) {
        const std::array<double, 2> own = limits;
        limits = {number(min, own[0], unit), number(max, own[1], unit)};
        const std::array<double, 2> written = limits;
        limits = mended_range(written, own, about_zero);
        if (limits == written) return;
        note(std::max(line_of(max), line_of(min)),
             fmt::format("{} = {:g} and {} = {:g} leave no range: taken as {:g} to {:g}", min, written[0] / unit, max,
                         written[1] / unit, limits[0] / unit, limits[1] / unit));
    }
    void read_ranges() {
        tire().load = {0, 100 * tire().nominal_load};
        range(tire().load, "FZMIN", "FZMAX", units_.force, false);
        range(tire().slip, "KPUMIN", "KPUMAX", 1, true);
        range(tire().angle, "ALPMIN", "ALPMAX", units_.angle, true);
        range(tire().camber, "CAMMIN", "CAMMAX", units_.angle, true);
        constexpr double max_slope = 1.55;  // tan 89 degrees is as good as sideways
        for (double& angle : tire().angle) angle = std::clamp(angle, -max_slope, max_slope);
        for (double& angle : tire().camber) angle = std::clamp(angle, -1.5, 1.5);
    }

    void read_coefficients() {
        std::string filled;
        std::size_t missing = 0;
        for (std::size_t i = 0; i < magic_count; ++i) {
            const auto& [name, default_value] = magic_coefficients[i];
            auto value = name == "LFZO"    ? either(name, "LFZ0")
                         : name == "PPMX1" ? either(name, "QPX1")
                                           : optional(name);
            tire().coefficients[i] = value.value_or(default_value);
            if (!value && expected(name, tire().angle_slip)) {
                filled += fmt::format("{}{} = {:g}", filled.empty() ? "" : ", ", name, default_value);
                ++missing;
            }
        }
        if (missing) note(0, fmt::format("{} coefficients are not in the file and taken as: {}", missing, filled));
        for (const MagicName divisor :
             {PCX1, PDX1, PKX1, PCY1, PDY1, PKY1, PKY2, PKY4, LFZO, LMUX, LMUY, LKX, LKY, LCX, LCY}) {
            if (tire().coefficients[divisor] != 0) continue;
            const std::string_view name = magic_coefficients[divisor].name;
            fail(line_of(name), fmt::format("key '{}' = 0: expected a number other than zero", name));
        }
        if (const auto complaint = complaint_about_coefficients(tire())) fail(0, *complaint);
        for (const std::string& narrowed : narrow_ranges(tire())) note(0, narrowed);
        if (!(tire().load[0] < tire().load[1]))
            fail(line_of("PDX2"), "PDX1, PDX2, PDY1, PDY2 leave no friction; expected some between FZMIN and FZMAX");
    }

    // By load as MF 5.2, by the stiffness of the carcass as MF 6, or, where the file has neither, by the tire's size.
    void choose_relaxation() {
        const MagicCoefficients& c = tire().coefficients;
        const auto along = optional("LONGITUDINAL_STIFFNESS", units_.stiffness());
        const auto across = optional("LATERAL_STIFFNESS", units_.stiffness());
        const bool by_load = c[PTX1] != 0 && c[PTY1] != 0 && c[PTY2] != 0;
        if (by_load && (tire().angle_slip || !(along && across))) {
            tire().relaxation_by_load = true;
        } else if (along && across && *along > 0 && *across > 0) {
            tire().carcass_x = *along, tire().carcass_y = *across;
        } else {
            const double load = tire().nominal_load, x = 1 / std::abs(c[PKY2]), radius = tire().nominal_radius;
            tire().carcass_x = std::abs(c[PKX1] * c[LKX]) * load / (0.7 * radius);
            tire().carcass_y = std::abs(c[PKY1] * c[LKY]) * load * 2 * x / (1 + x * x) / radius;
            note(0, fmt::format("neither PTX1, PTY1 nor LONGITUDINAL_STIFFNESS, LATERAL_STIFFNESS: relaxation lengths "
                                "estimated as 0.7 and 1 unloaded radius at the nominal load"));
        }
        const auto possible = [](double stiffness) { return stiffness >= min_in_tir && stiffness <= max_in_tir; };
        if (!tire().relaxation_by_load && !(possible(tire().carcass_x) && possible(tire().carcass_y))) {
            fail(line_of("LATERAL_STIFFNESS"), "LONGITUDINAL_STIFFNESS, LATERAL_STIFFNESS: expected positive numbers");
        }
    }

    // R - Fz0/Cz (D atan B + F): the effective rolling radius at the nominal load.
    void choose_rolling_radius() {
        CasingDescription& casing = tire().casing;
        const double deflection = tire().nominal_load / casing.vertical_stiffness;
        const auto B = optional("BREFF"), D = optional("DREFF"), F = optional("FREFF");
        if (overrides_.rolling_radius) {
            casing.rolling_radius = *overrides_.rolling_radius;
        } else if (B && D && F) {
            casing.rolling_radius = casing.radius - deflection * (*D * std::atan(*B) + *F);
        } else {
            casing.rolling_radius = casing.radius - deflection / 3;
            note(0,
                 "no BREFF, DREFF, FREFF: rolling radius taken as a third of the way from the unloaded to the loaded "
                 "one");
        }
        const bool own = !overrides_.radius && !overrides_.rolling_radius;  // else the vehicle's file is at fault
        if (!own || possible_rolling_radius(casing)) return;
        const double written = casing.rolling_radius;
        casing.rolling_radius = casing.radius - deflection / 3;
        const std::string text = fmt::format(
            "rolling radius {:g} m by BREFF, DREFF, FREFF is not between half the "
            "unloaded one and twice it",
            written);
        if (!possible_rolling_radius(casing)) fail(line_of("FREFF"), text);
        note(line_of("FREFF"), fmt::format("{}: taken as {:g} m, without them", text, casing.rolling_radius));
    }

    // What the file wants computed: forces in one direction only, or in both without each other.
    void apply_use_mode() {
        const PropertyEntry* entry = find("USE_MODE");
        if (!entry) return note(0, "no USE_MODE: taken as 14, combined with transients");
        const double written = std::abs(entry->number.value_or(-1));
        const int mode = static_cast<int>(std::fmod(written, 10)),
                  transient = static_cast<int>(std::fmod(written, 100)) / 10;
        if (!entry->number || mode > 5 || written >= 1000 || transient > 3) {
            fail(entry->line, fmt::format("key 'USE_MODE' = {}: expected 0 to 5, with 10, 20 or 30 more for transients",
                                          quoted_text(entry->text)));
        }
        if (*entry->number < 0) tire() = mirrored(tire());
        MagicCoefficients& c = tire().coefficients;
        const auto none = [&c](std::initializer_list<MagicName> names) {
            for (const MagicName name : names) c[name] = 0;
        };
        tire().has_longitudinal = mode == 1 || mode >= 3;
        tire().has_lateral = mode >= 2;
        tire().has_combined = mode >= 4;
        if (mode < 4) none({RBX1, RBX3, RBY1, RBY4, RVY1, RVY2, RVY3, SSZ1, SSZ2, SSZ3, SSZ4});
        if (mode == 0 || mode == 2) none({QSY1, QSY2, QSY3, QSY4, QSY5, QSY6});
        if (mode == 5) note(entry->line, "USE_MODE asks for turn slip: not modeled, as without");
        if (transient == 0)
            note(entry->line,
                 "USE_MODE asks for steady forces: transients are always on, and steady rolling is the same");
        if (transient == 3) note(entry->line, "USE_MODE asks for a belt: not modeled, relaxation instead");
    }

    void apply_side() {
        const PropertyEntry* entry = find("TYRESIDE");
        const std::string side = entry ? upper_case(entry->text) : "";
        if (side == "RIGHT") {
            tire() = mirrored(tire());
        } else if (side == "SYMMETRIC") {
            tire() = symmetric(tire());
        } else if (side != "LEFT") {
            note(entry ? entry->line : 0,
                 side.empty() || side == "UNKNOWN"
                     ? "no TYRESIDE: assumed LEFT"
                     : fmt::format("TYRESIDE {} is not LEFT, RIGHT or SYMMETRIC: assumed LEFT", quoted_text(side)));
        }
    }

    const TirOverrides& overrides_;
    PropertyUnits units_;
    TirFile out_;
};

}  // namespace

TirFile tir_from(const PropertyFile& file, const TirOverrides& overrides) {
    return TirReader(file, overrides).read();
}

TirFile read_tir(const std::string& path, const TirOverrides& overrides) {
    return tir_from(read_property_file(path), overrides);
}

}  // namespace hamilcar::io
