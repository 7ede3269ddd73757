// A scenario with everything that a checkpoint has to keep.
#pragma once

#include "support/car.hpp"

namespace hamilcar::test {

// A driver on a bent path who shifts and holds a speed.
inline ScenarioDescription driven() {
    ScenarioDescription s = scenario(6, 8);
    s.driver.steering.emplace();
    s.driver.steering->path.points = {{0, 0}, {40, 0}, {80, 6}, {140, 6}, {200, 0}};
    s.driver.speed.emplace();
    s.driver.speed->speed = {{0, 6}, {8, 20}, Interpolation::linear};
    s.driver.shifting.emplace();
    return s;
}

}  // namespace hamilcar::test
