// Where a unit of a sampled vehicle stands on the ground: the motor vehicle is unit 0, trailer i unit i + 1.
#pragma once

#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

template <class AnySample>
UnitPose<typename AnySample::Number> unit_pose_of(const AnySample& s, std::size_t unit) {
    if (unit == 0) return {s.state.position(), s.velocity.R_GC};
    const std::size_t trailer = unit - 1;
    const auto tow = static_cast<std::size_t>(s.model.vehicle.trailers[trailer].tow);
    return behind(unit_pose_of(s, tow), s.velocity.trailers[trailer].pose);
}

}  // namespace hamilcar
