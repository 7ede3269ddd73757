// The tree of differentials. A file lists them in any order and names their outputs; a description numbers them from the
// wheels upward.
#include "hamilcar/io/vehicle_tables.hpp"

#include <algorithm>

#include "hamilcar/io/choices.hpp"
#include "hamilcar/io/default_values.hpp"
#include "hamilcar/io/spelling.hpp"

namespace hamilcar::io {

namespace {

struct Entry {
    TableReader table;
    DifferentialDescription differential;
};

// A locking value is |T_b - T_a| / (T_a + T_b), a bias ratio T_b / T_a; both say what the lock passes on as a share of
// T_a + T_b: half of the value, and half of (bias - 1) / (bias + 1).
void read_lock(const TableReader& table, DifferentialDescription& to) {
    constexpr Range from_one{"number not below 1", 1};
    const bool has_preload = to.kind == DifferentialKind::limited_slip || to.kind == DifferentialKind::torque_biasing;
    if (has_preload) to.preload = table.number("preload_N_m", not_negative, 0);
    if (to.kind == DifferentialKind::limited_slip) {
        to.locking_drive = table.number("locking_value_drive", fraction) / 2;
        to.locking_coast = table.number("locking_value_coast", fraction) / 2;
    } else if (to.kind == DifferentialKind::torque_biasing) {
        const double bias = table.number("bias_ratio", from_one);
        to.locking_drive = to.locking_coast = (bias - 1) / (bias + 1) / 2;
    } else if (to.kind == DifferentialKind::viscous) {
        to.viscosity = table.number("viscosity_N_m_s_per_rad", positive);
    }
}

DifferentialDescription read_differential(const TableReader& table, double chassis_mass) {
    constexpr std::string_view kinds[] = {"open", "locked", "limited_slip", "torque_biasing", "viscous"};
    DifferentialDescription out;
    out.name = table.text("name");
    table.choose("kind", kinds, 0, [&](std::size_t kind) {
        out.kind = static_cast<DifferentialKind>(kind);
        read_lock(table, out);
    });
    out.ratio = table.number("ratio", positive, 1);
    out.share = table.number("torque_share", fraction, out.share);
    out.shaft_stiffness =
        table.number_or_else("shaft_stiffness_N_m_per_rad", positive, default_shaft_stiffness(chassis_mass));
    out.damping_ratio = table.number("damping_ratio", not_negative, out.damping_ratio);
    out.shaft_axis = table.direction("shaft_axis", out.shaft_axis);
    return out;
}

struct DrivenWheel {
    std::string name;
    bool on_trailer;
};

std::vector<DrivenWheel> wheels_of(const VehicleDescription& vehicle) {
    std::vector<DrivenWheel> wheels;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t unit) { wheels.push_back({wheel.name, unit > 0}); });
    return wheels;
}

// What a name among a differential's outputs stands for; differentials by their place in the file.
DrivenPart find_output(const TableReader& table, const std::string& name, const std::vector<Entry>& entries,
                       const std::vector<DrivenWheel>& wheels) {
    const auto of = [](const Entry& entry) { return entry.differential.name; };
    const auto inner = std::ranges::find(entries, name, of);
    if (inner != entries.end()) return {.wheel = false, .number = static_cast<std::size_t>(inner - entries.begin())};
    const auto wheel = std::ranges::find(wheels, name, &DrivenWheel::name);
    std::vector<std::string_view> known;
    for (const Entry& entry : entries) known.push_back(entry.differential.name);
    for (const DrivenWheel& other : wheels) {
        if (!other.on_trailer) known.push_back(other.name);
    }
    const std::string hint = did_you_mean(name, known);
    table.expect(
        wheel != wheels.end(), "outputs",
        "names of wheels or of other differentials, which '" + name + "' is not" + (hint.empty() ? "" : "; " + hint));
    table.expect(!wheel->on_trailer, "outputs", "wheels of the motor vehicle, which '" + name + "' is not");
    return {.wheel = true, .number = static_cast<std::size_t>(wheel - wheels.begin())};
}

void connect(std::vector<Entry>& entries, const VehicleDescription& vehicle) {
    const std::vector<DrivenWheel> wheels = wheels_of(vehicle);
    std::vector<std::string> driven;
    for (Entry& entry : entries) {
        const std::vector<std::string> names = entry.table.texts("outputs");
        entry.table.expect(names.size() == 2, "outputs", "two names of wheels or of other differentials");
        for (std::size_t i = 0; i < 2; ++i) {
            entry.differential.outputs[i] = find_output(entry.table, names[i], entries, wheels);
            entry.table.expect(std::ranges::find(driven, names[i]) == driven.end(), "outputs",
                               "outputs that nothing else drives, as something does '" + names[i] + "'");
            driven.push_back(names[i]);
        }
    }
}

// Places of the entries, each after those that it drives.
std::vector<std::size_t> upward(const std::vector<Entry>& entries) {
    std::vector<std::size_t> order, open(entries.size());
    for (std::size_t i = 0; i < open.size(); ++i) open[i] = i;
    const auto is_ready = [&](std::size_t i) {
        return std::ranges::all_of(entries[i].differential.outputs, [&](const DrivenPart& output) {
            return output.wheel || std::ranges::find(order, output.number) != order.end();
        });
    };
    while (!open.empty()) {
        const auto next = std::ranges::find_if(open, is_ready);
        // Each has one input at most, so those that are left stand in circles.
        entries[open[0]].table.expect(next != open.end(), "outputs",
                                      "outputs without a cycle: these lead back to their own input");
        order.push_back(*next);
        open.erase(next);
    }
    return order;
}

}  // namespace

std::vector<TableReader> read_differentials(const TableReader& file, VehicleDescription& vehicle) {
    std::vector<std::string> taken;
    for (const DrivenWheel& wheel : wheels_of(vehicle)) taken.push_back(wheel.name);
    std::vector<Entry> entries;
    for (const TableReader& table : file.tables("differential")) {
        check_name(table, taken, "differential or wheel");
        entries.push_back({table, read_differential(table, vehicle.chassis.mass)});
        if (file.is_recording()) static_cast<void>(table.texts("outputs"));
    }
    if (file.is_recording()) return {};
    file.expect(entries.size() <= std::size_t{max_differentials}, "differential",
                std::to_string(max_differentials) + " differentials at most");
    connect(entries, vehicle);
    const std::vector<std::size_t> order = upward(entries);
    std::vector<TableReader> tables;
    for (const std::size_t place : order) {
        DifferentialDescription differential = entries[place].differential;
        for (DrivenPart& output : differential.outputs) {
            if (output.wheel) continue;
            output.number = static_cast<std::size_t>(std::ranges::find(order, output.number) - order.begin());
        }
        vehicle.differentials.push_back(differential);
        tables.push_back(entries[place].table);
    }
    return tables;
}

}  // namespace hamilcar::io
