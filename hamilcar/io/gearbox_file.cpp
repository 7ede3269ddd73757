// From a rotor to the shaft behind its gearbox: clutch, converter, gears and shafts.
#include <algorithm>

#include "hamilcar/base/text.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/io/choices.hpp"
#include "hamilcar/io/vehicle_tables.hpp"

namespace hamilcar::io {

namespace {

using units::rpm;

// Between two points ratio and torque ratio are linear, their product, turbine power over pump power, a parabola.
double max_efficiency(const Samples& torque_ratio) {
    double max_found = 0;
    const auto look = [&](double nu, double ratio) { max_found = std::max(max_found, nu * ratio); };
    for (std::size_t i = 0; i < torque_ratio.argument.size(); ++i) {
        const double x = torque_ratio.argument[i], y = torque_ratio.value[i];
        look(x, y);
        if (i + 1 == torque_ratio.argument.size()) break;
        const double next = torque_ratio.argument[i + 1], slope = (torque_ratio.value[i + 1] - y) / (next - x);
        const double top = slope < 0 ? 0.5 * (x - y / slope) : next;
        if (top > x && top < next) look(top, y + slope * (top - x));
    }
    return max_found;
}

ConverterDescription read_converter(const TableReader& table) {
    constexpr std::string_view pump_key = "pump_torque_at_2000rpm_N_m";
    const Samples curve = table.samples("speed_ratio", "torque_ratio", positive);
    expect_points(table, "speed_ratio", curve.argument.size());
    table.expect(curve.argument.front() >= 0 && curve.argument.back() <= 1, "speed_ratio", "numbers from 0 to 1");
    ConverterDescription converter{.speed_ratio = curve.argument,
                                   .torque_ratio = curve.value,
                                   .capacity = table.numbers(pump_key, not_negative),
                                   .lockup_capacity = table.number("lockup_capacity_N_m", not_negative, 0)};
    table.expect(converter.capacity.size() == curve.argument.size(), pump_key,
                 std::to_string(curve.argument.size()) + " numbers, one for each of 'speed_ratio'");
    table.expect(max_efficiency(curve) <= 1 + 1e-9, "torque_ratio",
                 "numbers that times their speed ratio, there and between, are 1 at most: no converter makes power");
    table.expect(curve.argument.back() == 1, "speed_ratio", "a last number of 1, where pump and turbine turn alike");
    table.expect(converter.capacity.empty() || converter.capacity.back() == 0, pump_key,
                 "a last number of 0: what turns alike passes no torque");
    for (double& capacity : converter.capacity) capacity /= (2000 * rpm) * (2000 * rpm);
    return converter;
}

// A gear that was shifted to must not be left at once.
void check_shifts(const TableReader& table, const GearboxDescription& gearbox) {
    double step = 1;  // largest fall of the speed [1]
    for (std::size_t i = 0; i + 1 < gearbox.ratios.size(); ++i) {
        step = std::min(step, gearbox.ratios[i + 1] / gearbox.ratios[i]);
    }
    const auto check = [&](std::string_view key, double up, double down) {
        table.expect(gearbox.upshift_speed == 0 || down < up * step, key,
                     "a number below " + number_text(up * step / rpm) + ", which is left after shifting up");
    };
    check("downshift_rpm", gearbox.upshift_speed, gearbox.downshift_speed);
    check("downshift_closed_rpm", gearbox.upshift_speed_closed, gearbox.downshift_speed_closed);
    table.expect(!gearbox.automatic || gearbox.ratios.size() == 1 || gearbox.upshift_speed > 0, "upshift_rpm",
                 "a positive number: an automatic gearbox shifts by itself");
}

}  // namespace

std::variant<ClutchDescription, ConverterDescription> read_coupling(const TableReader& unit) {
    std::variant<ClutchDescription, ConverterDescription> out;
    unit.choose({{"clutch"}, {"converter"}}, [&](std::size_t group) {
        if (group == 1) {
            out = read_converter(unit.table("converter"));
        } else if (const auto clutch = unit.optional_table("clutch")) {
            out = ClutchDescription{clutch->number("capacity_N_m", not_negative)};
        }
    });
    return out;
}

GearboxDescription read_gearbox(const std::optional<TableReader>& table) {
    constexpr Range efficiency{"number above 0, 1 at most", 0, 1, false};
    GearboxDescription gearbox;
    if (!table) return gearbox;
    gearbox.ratios = table->numbers("ratios", positive);
    table->expect(gearbox.ratios.size() <= std::size_t{max_gears}, "ratios",
                  std::to_string(max_gears) + " gears at most");
    table->expect(std::ranges::adjacent_find(gearbox.ratios, std::ranges::less_equal{}) == gearbox.ratios.end(),
                  "ratios", "numbers that decrease, from first gear on");
    gearbox.reverse_ratio = table->number("reverse_ratio", not_negative, 0);
    gearbox.efficiency = table->number("efficiency", efficiency, 1);
    gearbox.automatic = word<bool>(*table, "shift", {{"manual", false}, {"automatic", true}});
    gearbox.shift_time = table->number("shift_time_s", not_negative, gearbox.shift_time);
    gearbox.upshift_speed = table->number("upshift_rpm", not_negative, 0);
    gearbox.upshift_speed_closed = table->number_or_else("upshift_closed_rpm", not_negative, gearbox.upshift_speed);
    gearbox.downshift_speed = table->number("downshift_rpm", not_negative, 0);
    gearbox.downshift_speed_closed =
        table->number_or_else("downshift_closed_rpm", not_negative, gearbox.downshift_speed);
    check_shifts(*table, gearbox);
    return gearbox;
}

ShaftsDescription read_shafts(const std::optional<TableReader>& table) {
    ShaftsDescription out;
    if (!table) return out;
    constexpr Range backlash{"number from 0 to 45", 0, 45};  // [deg]
    out.exists = true;
    out.gearbox_inertia = table->number("gearbox_inertia_kg_m2", positive);
    out.stiffness = table->number("stiffness_N_m_per_rad", positive);
    out.damping_ratio = table->number("damping_ratio", not_negative, out.damping_ratio);
    out.backlash = table->number("backlash_deg", backlash, 0);
    return out;
}

}  // namespace hamilcar::io
