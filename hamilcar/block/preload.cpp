#include "hamilcar/block/preload.hpp"

#include <algorithm>

#include "hamilcar/block/equilibrium.hpp"
#include "hamilcar/block/initial_process.hpp"
#include "hamilcar/math/dense.hpp"

namespace hamilcar {

namespace {

std::vector<std::size_t> carrying_springs(const SuspensionDescription& suspension) {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < suspension.springs.size(); ++i) {
        if (suspension.springs[i].spring.carries) out.push_back(i);
    }
    return out;
}

// Where the vehicle stands at rest with these suspensions held at design.
struct Rest {
    Velocity<double> velocity;
    Momenta<double> momenta;
    State<double> state;
};
std::optional<Rest> rest_with(const Model<double>& model, const std::vector<bool>& held) {
    const Input<double> input;
    Rest rest;
    rest.state = design_state(model, Vec3<double>::Zero(), Mat3<double>::Identity());
    if (!settle(model, input, rest.state, held).found) return {};
    rest.velocity = velocity_block(model, rest.state, input);
    rest.momenta = momenta_block(model, rest.state, input, rest.velocity);
    return rest;
}

}  // namespace

std::optional<std::string> find_preloads(VehicleDescription& vehicle) {
    std::vector<bool> held;
    VehicleDescription unloaded =
        vehicle;  // its carrying springs without any force; their seats come on top of what is found
    for (SuspensionDescription& suspension : unloaded.suspensions) {
        const auto carrying = carrying_springs(suspension);
        for (const std::size_t i : carrying) {
            suspension.springs[i].spring.force_at_design = suspension.springs[i].spring.seat = 0;
        }
        held.push_back(!carrying.empty());
    }
    if (std::ranges::find(held, true) == held.end()) return {};
    const Model<double> model{.vehicle = Vehicle<double>(unloaded), .road = PlaneRoad<double>(0, 0, 1)};
    const std::optional<Rest> rest = rest_with(model, held);
    if (!rest) return "a vehicle that rests on its tires while its suspensions are at design";
    for (std::size_t s = 0; s < vehicle.suspensions.size(); ++s) {
        if (!held[s]) continue;
        const Suspension<double>& suspension = model.vehicle.suspensions[s];
        const auto at = suspension.state(rest->state.values.data());
        const auto carrying = carrying_springs(vehicle.suspensions[s]);
        const Eigen::Index n = suspension.linkage.nV();
        Eigen::MatrixXd lever(n, static_cast<Eigen::Index>(carrying.size()));  // of each force on each freedom
        Eigen::VectorXd load(n);
        for (Eigen::Index j = 0; j < n; ++j) {
            load[j] = -rest->momenta.suspensions[s].momentum_rate[static_cast<std::size_t>(j)];
            for (Eigen::Index c = 0; c < lever.cols(); ++c) {
                const auto& spring = suspension.springs[carrying[static_cast<std::size_t>(c)]];
                const auto line = suspension.linkage.line(spring.line, rest->velocity.suspensions[s].at, at.independent,
                                                          at.dependent);
                lever(j, c) = line.gradient[static_cast<std::size_t>(j)];
            }
        }
        const Eigen::VectorXd force = shortest_least_squares(lever, load);
        constexpr double round_off = 1e-9;
        if (!((lever * force - load).norm() <= round_off * load.norm())) {
            const std::string& name = vehicle.suspensions[s].springs[carrying[0]].name;
            return "a spring that moves with its wheel, for '" + name + "' to carry the vehicle at design";
        }
        for (std::size_t c = 0; c < carrying.size(); ++c) {
            vehicle.suspensions[s].springs[carrying[c]].spring.force_at_design = force[static_cast<Eigen::Index>(c)];
        }
    }
    return {};
}

}  // namespace hamilcar
