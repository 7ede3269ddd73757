// Torque vectoring: the motors of the two sides of an axle pull against each other so that the car turns as a neutral car would with the
// driver's steering angle (docs/controllers/torque_vectoring.md). What one side gains the other loses: the sum stays the driver's.
#include <algorithm>
#include <cmath>

#include "hamilcar/control/kinds.hpp"
#include "hamilcar/control/reference_speed.hpp"

namespace hamilcar {

namespace {

constexpr double gravity = 9.80665;  // [m/s^2]
constexpr double least_speed = 2;    // below, wheels' speeds tell too little of the car's [m/s]
constexpr double full_speed = 5;     // from where on it acts in full [m/s]

struct VectoringMemory {
    ReferenceSpeed reference;
    double asked = 0;  // yaw rate, lagged [rad/s]
    double activity = 0;
};

// Two motors, each of which drives one wheel of an axle.
struct MotorPair {
    std::size_t left, right;         // units
    double left_share, right_share;  // command for a yaw moment of 1 N m [1/(N m)]
};

class TorqueVectoring final : public Controller {
public:
    TorqueVectoring(const ControllerSettings& settings, const ControlledCar& car)
        : car_(car),
          characteristic_speed_(settings["characteristic_speed_m_per_s"]),
          gain_(settings["gain_per_s"]),
          response_time_(settings["response_time_s"]),
          friction_(settings["friction"]),
          largest_(settings["largest_share"]) {
        find_pairs();
    }

    std::size_t memory_size() const override { return numbers_of<VectoringMemory>(); }
    double activity(std::span<const double> memory) const override {
        return read_memory<VectoringMemory>(memory).activity;
    }
    void decide(const Measured& measured, std::span<double> memory, const Commands& commands) const override {
        auto state = read_memory<VectoringMemory>(memory);
        update_speed(state.reference, car_, measured);
        const double v = state.reference.speed;
        const double rate = asked_rate(std::max(v, least_speed), measured);
        state.asked += (rate - state.asked) * std::min(measured.interval / response_time_, 1.0);
        const double acts =
            measured.gear <= 0 ? 0 : std::clamp((v - least_speed) / (full_speed - least_speed), 0.0, 1.0);
        const double missing = state.asked - measured.angular_rate[2];
        const double moment = acts * gain_ * car_.yaw_inertia * missing / static_cast<double>(pairs_.size());
        state.activity = 0;
        for (const MotorPair& pair : pairs_) {
            // One limit for both sides, so that they stay opposite.
            const double strongest = std::max(pair.left_share, pair.right_share);
            const double most = largest_ / strongest, own = std::clamp(moment, -most, most);
            commands.added_torque(pair.left) = -own * pair.left_share;
            commands.added_torque(pair.right) = own * pair.right_share;
            state.activity = std::max(state.activity, std::abs(own) / most);
        }
        write_memory(state, memory);
    }

private:
    double asked_rate(double v, const Measured& measured) const {
        const double relative = v / characteristic_speed_;
        const double angle = measured.steering_wheel * car_.wheels_per_angle;
        const double asked = v * angle / (car_.wheelbase * (1 + relative * relative));
        const double most = friction_ * gravity / v;
        return std::clamp(asked, -most, most);
    }

    // A force at a wheel turns the car by its distance from the middle.
    double share_per_moment(const ControlledUnit& unit) const {
        const ControlledWheel& wheel = car_.wheels[unit.wheels[0]];
        return wheel.radius / (2 * std::abs(wheel.y) * unit.ratio * unit.motor_torque);
    }

    void find_pairs() {
        const auto drives_one = [](const ControlledUnit& unit) {
            return unit.wheels.size() == 1 && unit.motor_torque > 0;
        };
        for (std::size_t i = 0; i < car_.units.size(); ++i) {
            for (std::size_t k = 0; k < car_.units.size(); ++k) {
                if (i == k || !drives_one(car_.units[i]) || !drives_one(car_.units[k])) continue;
                const ControlledWheel &left = car_.wheels[car_.units[i].wheels[0]],
                                      &right = car_.wheels[car_.units[k].wheels[0]];
                if (!on_one_axle(left, right) || left.y <= 0 || right.y >= 0) continue;
                pairs_.push_back({i, k, share_per_moment(car_.units[i]), share_per_moment(car_.units[k])});
            }
        }
    }

    ControlledCar car_;
    double characteristic_speed_, gain_, response_time_, friction_, largest_;
    std::vector<MotorPair> pairs_;
};

// Of a motor's wheel, its number in the vehicle; -1: it drives several.
std::ptrdiff_t own_wheel(const PowerUnitDescription& unit) {
    const bool one = unit.output.wheel && std::holds_alternative<MotorDescription>(unit.source);
    return one ? static_cast<std::ptrdiff_t>(unit.output.number) : -1;
}

std::string lacks(const VehicleDescription& vehicle) {
    if (vehicle.steering.rack_per_revolution <= 0) return "a steering wheel";
    std::vector<Point> centers;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) { centers.push_back(wheel.wheel.center); });
    for (const PowerUnitDescription& left : vehicle.power_units) {
        for (const PowerUnitDescription& right : vehicle.power_units) {
            if (own_wheel(left) < 0 || own_wheel(right) < 0) continue;
            const Point &a = centers[static_cast<std::size_t>(own_wheel(left))],
                        &b = centers[static_cast<std::size_t>(own_wheel(right))];
            if (a[0] == b[0] && a[1] > 0 && b[1] < 0) return "";
        }
    }
    return "an axle each of whose wheels has a motor of its own";
}

}  // namespace

ControllerKind torque_vectoring() {
    return {
        .keyword = "torque_vectoring",
        .meaning = "motors left and right pull against each other so that the car turns as it is steered",
        .keys = {{"characteristic_speed_m_per_s", "at which it shall need twice the steering angle of a neutral car",
                  60, 10, 500},
                 {"gain_per_s", "yaw acceleration wanted for each unit of yaw rate that is missing", 8, 0, 100},
                 {"response_time_s", "in which the car shall follow the steering wheel", 0.08, 0.005, 1},
                 {"friction", "that the wanted yaw rate goes up to, as lateral acceleration over gravity", 0.9, 0.1, 3},
                 {"largest_share", "of a motor's largest torque that it may add or take", 0.5, 0, 1}},
        .lacks = lacks,
        .make = [](const ControllerSettings& settings, const ControlledCar& car) -> std::unique_ptr<const Controller> {
            return std::make_unique<TorqueVectoring>(settings, car);
        }};
}

}  // namespace hamilcar
