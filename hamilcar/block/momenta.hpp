// Momenta block (paper, section 6.1 (2)): forces, then the rates of the momenta.
//
//     P_V' of every spoke (spoke_momenta.hpp), and of composed ones and trailers (composed_momenta.hpp)
//     p' = F,  L' = N_O - r' x p                                 // external forces only
#pragma once

#include "hamilcar/block/powertrain_momenta.hpp"
#include "hamilcar/block/spoke_momenta.hpp"

namespace hamilcar {

template <class T, class S = T>
struct Momenta {
    Spatial<T> external;  // (F ; N_O) on the whole car, chassis axes
    T work_rate;          // [W]
    std::array<SpokeMomenta<S>, max_spokes> spokes;
    ComposedMomentaOfAll<T> composed;  // and trailers
    PowertrainMomenta<T> powertrain;   // where there is one
    Momenta() {}
};

// Forces of the bars on the spokes along their wheels' travel: they couple spokes before any of them is finished.
template <class T, class S>
std::array<T, max_spokes> anti_roll_forces(const Vehicle<T>& vehicle, const Velocity<T, S>& velocity) {
    std::array<T, max_spokes> travel, force;
    vehicle.template for_each_row<S>([&](const auto& row, int i) {
        visit_spoke(row.spokes, velocity, i, [&](const Spoke<S>& spoke, const auto&, const auto& at) {
            const S own = wheel_travel(spoke, at);
            for (std::size_t l = 0; l < static_cast<std::size_t>(row.count); ++l) {
                travel[static_cast<std::size_t>(row.index[l])] = at_place<T>(own, static_cast<int>(l));
                force[static_cast<std::size_t>(row.index[l])] = T(0);
            }
        });
    });
    for (const AntiRollBar<T>& bar : vehicle.anti_roll_bars) {
        const T pull = bar.rate * (travel[bar.left] - travel[bar.right]);
        force[bar.left] -= pull;
        force[bar.right] += pull;
    }
    return force;
}

// What the ground, the air and gravity do to the chassis itself.
template <class T>
void chassis_momenta(const Vehicle<T>& vehicle, const Surroundings<T>& world, const Vec3<T>& wind,
                     const GroundBelow<T>& ground, Spatial<T>& external, T& work_rate) {
    const auto air = vehicle.aerodynamics.evaluate(world.hub, wind);
    const WheelRoad<T> below = ground_of_hull(ground, vehicle.hull, world.hub);
    const auto hull = vehicle.hull.contact(below.plane, world.hub, below.rise);
    external = air.wrench + hull.wrench +
               spatial<T>(world.gravity * vehicle.chassis.mass, vehicle.chassis_inertia.moment.cross(world.gravity));
    work_rate = air.power + hull.lost_power;
}

template <Account account, class S, class T>
Momenta<T, S> momenta_block_of(const Model<T>& model, const State<T>& state, const Input<T>& input,
                               const Velocity<T, S>& velocity) {
    Momenta<T, S> out;
    const Vehicle<T>& vehicle = model.vehicle;
    const Surroundings<T> world{model.road.seen_from(state.position(), velocity.R_GC),
                                velocity.R_GC.row(2).transpose() * (-vehicle.gravity), velocity.hub,
                                model.stabilization_gain};
    UnevenGround<RoadNumber<T>> uneven;
    const UnitPlace<T> place{state.position(), velocity.R_GC};
    const GroundBelow<T> below_chassis = ground_below(model, place, world.road, input.time, uneven);
    const Mat3<T>& R = velocity.R_GC;
    const Vec3<T> wind = R.row(0).transpose() * input.wind_x + R.row(1).transpose() * input.wind_y;
    chassis_momenta(vehicle, world, wind, below_chassis, out.external, out.work_rate);
    ShaftTorques<T> shafts;
    const bool powered = vehicle.powertrain.exists();
    if (powered) {
        powertrain_momenta(vehicle, state, input, velocity, corner_axes<T, S>(vehicle, velocity), out.powertrain,
                           shafts, out.work_rate);
    }
    const std::array<T, max_spokes> bars = anti_roll_forces(vehicle, velocity);
    const Surroundings<S> around = abreast<S>(world);
    const Input<S> inputs = abreast<S>(input);
    const GroundBelow<S> ground{around.road, below_chassis.uneven};
    std::array<Spatial<S>, max_spokes> tires;
    vehicle.template for_each_row<S>([&](const auto& row, int i) {
        const auto numbers = gather_row<S>(state, row.index);
        visit_spoke(row.spokes, velocity, i, [&](const Spoke<S>& spoke, const auto&, const auto& at) {
            const GroundOfWheel<S> below{ground, {row.index[0], row.index[1]}};
            S drive = spoke.drive_share * inputs.drive_torque;
            if (powered) drive += from_places<S>(shafts.corners, row.index);
            tires[i] =
                wheel_momenta<account>(spoke, at, spoke_view(numbers), inputs.brake, drive, below, out.spokes[i]);
        });
    });
    PlaceSum<T, S, std::tuple_size_v<SpokeShare<S>>> sum;
    vehicle.template for_each_row<S>([&](const auto& row, int i) {
        const auto numbers = gather_row<S>(state, row.index);
        visit_spoke(row.spokes, velocity, i, [&](const Spoke<S>& spoke, const auto& suspension, const auto& at) {
            sum.add(spoke_momenta<account>(spoke, suspension, at, spoke_view(numbers), inputs, around, tires[i],
                                           from_places<S>(bars, row.index), out.spokes[i]),
                    row);
        });
    });
    const SpokeShare<T> spokes = sum.total();
    for (int k = 0; k < 6; ++k) out.external[k] += spokes[static_cast<std::size_t>(k)];
    out.work_rate += spokes.back();
    if (vehicle.has_composed()) {
        composed_momenta(model, state, input, velocity.composed, velocity.R_GC, world,
                         powered ? &shafts.composed : nullptr, out.composed, out.external, out.work_rate);
    }
    return out;
}

// Spoke after spoke with everything that channels and the energy balance read.
template <class T>
Momenta<T> momenta_block(const Model<T>& model, const State<T>& state, const Input<T>& input,
                         const Velocity<T>& velocity) {
    return momenta_block_of<Account::full>(model, state, input, velocity);
}

extern template Momenta<double> momenta_block<double>(const Model<double>&, const State<double>&, const Input<double>&,
                                                      const Velocity<double>&);

}  // namespace hamilcar
