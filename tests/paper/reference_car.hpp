// The BMW 323i of the tests, from the numbers of the shipped vehicle (left side given, right side mirrored): bodies,
// hardpoints and the elastic parts. The tires are vertical springs; link lengths come from the hardpoints.
#pragma once

#include "hamilcar/description/vehicle.hpp"

namespace hamilcar::paper {

inline Point mirrored(const Point& p) {
    return {p[0], -p[1], p[2]};
}

inline CornerDescription mirrored(CornerDescription corner) {
    if (auto* strut = std::get_if<MacPhersonDescription>(&corner.suspension)) {
        for (Point* p : {&strut->strut_top, &strut->slide_point, &strut->arm_front, &strut->arm_rear,
                         &strut->ball_joint, &strut->rack_end, &strut->tie_rod_outer}) {
            *p = mirrored(*p);
        }
    } else if (auto* arm = std::get_if<SemiTrailingArmDescription>(&corner.suspension)) {
        for (Point* p : {&arm->inner_bush, &arm->outer_bush, &arm->spring_arm, &arm->spring_body, &arm->damper_arm,
                         &arm->damper_body}) {
            *p = mirrored(*p);
        }
    }
    corner.carrier.center_of_mass = mirrored(corner.carrier.center_of_mass);
    corner.carrier.products[0] = -corner.carrier.products[0];
    corner.carrier.products[1] = -corner.carrier.products[1];
    corner.wheel.center = mirrored(corner.wheel.center);
    const Point e = corner.wheel.spin_axis;
    corner.wheel.spin_axis = {-e[0], e[1], -e[2]};
    return corner;
}

inline CornerDescription front_left() {
    CornerDescription corner;
    corner.name = "front_left";
    corner.suspension = MacPhersonDescription{.strut_top = {-0.1051, 0.4962, 0.795},
                                              .slide_point = {-0.024, 0.6013, 0.28},
                                              .arm_front = {0.0, 0.318, 0.1886},
                                              .arm_rear = {-0.295, 0.335, 0.1886},
                                              .ball_joint = {-0.006, 0.6525, 0.165},
                                              .rack_end = {0.1069, 0.3247, 0.2132},
                                              .tie_rod_outer = {0.1115, 0.6969, 0.19},
                                              .rack_axis = {0, 1, 0},
                                              .arm_length = {},
                                              .tie_rod_length = {}};
    corner.carrier = {35.0, {-0.01, 0.6601, 0.31}, {0.9, 0.38, 0.62}, {}};
    corner.wheel = {{0, 0.7001, 0.28}, {0.002705, 0.999924, 0.012042}, 0.85};
    corner.spring = {26200, 2951};
    corner.damper = {{-1, 1}, {-2093, 2093}};
    corner.tire = SpringTireDescription{0.2948, 0.2948, 180000};
    return corner;
}

inline CornerDescription rear_left() {
    CornerDescription corner;
    corner.name = "rear_left";
    corner.suspension = SemiTrailingArmDescription{.inner_bush = {-2.277, 0.1753, 0.28},
                                                   .outer_bush = {-2.1735, 0.5617, 0.28},
                                                   .spring_arm = {-2.4924, 0.48, 0.235},
                                                   .spring_body = {-2.48, 0.48, 0.47},
                                                   .damper_arm = {-2.64, 0.545, 0.24},
                                                   .damper_body = {-2.6, 0.53, 0.7}};
    corner.carrier = {39.0, {-2.527, 0.6239, 0.28}, {0.85, 0.4, 1.05}, {}};
    corner.wheel = {{-2.57, 0.6989, 0.28}, {0.002705, 0.99953, 0.030539}, 0.85};
    corner.spring = {40700, 3339};
    corner.damper = {{-1, 1}, {-1487, 1487}};
    corner.tire = SpringTireDescription{0.2948, 0.2948, 180000};
    corner.drive_share = 0.5;
    return corner;
}

inline VehicleDescription reference_car() {
    VehicleDescription car;
    car.name = "BMW 323i (E30-based, five-body model)";
    car.chassis = {1002.0, {-1.1524, 0, 0.6137}, {215.1, 1624.6, 1573.9}, {}};
    CornerDescription front_right = mirrored(front_left()), rear_right = mirrored(rear_left());
    front_right.name = "front_right";
    rear_right.name = "rear_right";
    car.corners = {front_left(), front_right, rear_left(), rear_right};
    car.anti_roll_bars = {{0, 1, 3493}, {2, 3, 1320}};
    car.steering = {0.0365, 0.073};
    return car;
}

}  // namespace hamilcar::paper
