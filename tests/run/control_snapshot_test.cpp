// Going back, and going on from a file, in the middle of a stop on which the anti-lock system works: what sensors and controllers
// remember and the commands that are held are part of the place to come back to.
#include <bit>
#include <cstring>
#include <fstream>
#include <iterator>

#include "hamilcar/io/checksum.hpp"
#include "hamilcar/run/checkpoint_fields.hpp"
#include "run/checkpoint_folder.hpp"
#include "support/allocation_guard.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

using testing::HasSubstr;

// All brakes on a slippery road, one side worse, seen through sensors that sample, are late, round and have noise.
Simulation panic_stop(double duration = 3) {
    VehicleDescription car = test::shipped("bmw_e90_330i");
    car.sensors.wheel_speed = {.interval = 2e-3, .delay = 4e-3, .resolution = 0.02, .noise = 0.05};
    car.sensors.acceleration = {.delay = 3e-3, .noise = 0.1};
    car.sensors.angular_rate = {.noise = 2e-3};
    ScenarioDescription s = test::scenario(duration, 25);
    s.road.friction = 0.5;
    s.road.patches.push_back({.left = 0, .friction = 0.4});
    s.brake = test::table({0.1, 0.2}, {0, 1});
    s.steering_input = SteeringInput::steering_wheel;
    s.steering = test::table({0.3, 0.8}, {0, 0.5});
    return Simulation(car, s);
}

void advance(Simulation& car, int steps) {
    for (int i = 0; i < steps; ++i) ASSERT_FALSE(car.advance());
}

void expect_same_everything(const Simulation& a, const Simulation& b) {
    expect_same(a, b);
    EXPECT_TRUE(std::ranges::equal(a.schedule().commands(), b.schedule().commands()));
    EXPECT_EQ(a.control_memory(), b.control_memory());
}

constexpr int middle = 1203;  // between two decisions [steps]

class ControlSnapshot : public Checkpoint {
protected:
    ControlSnapshot() : car_(panic_stop()), later_(car_) {
        advance(car_, middle);
        later_ = car_;
        advance(later_, 400);
        EXPECT_GT(car_.control()->activity(0, car_.control_memory()), 0.4) << "the anti-lock system is at work";
        EXPECT_FALSE(std::ranges::equal(car_.schedule().commands(), car_.control()->layout().rest()));
    }
    Simulation car_, later_;  // in the middle, and 400 steps later
};

TEST_F(ControlSnapshot, GoesBackToTheSameBits) {
    const auto snapshot = std::make_unique<Snapshot>();
    car_.save(*snapshot);
    Simulation other = panic_stop();
    for (Simulation* car : {&car_, &later_, &other}) {
        Simulation back(*car);
        back.restore(*snapshot);
        advance(back, 400);
        expect_same_everything(back, later_);
    }
}

TEST_F(ControlSnapshot, GoesOnFromAFileToTheSameBits) {
    write_checkpoint(path(), car_, {});
    Simulation other = panic_stop();
    read_checkpoint(path(), other);
    expect_same_everything(other, car_);
    advance(other, 400);
    expect_same_everything(other, later_);
}

TEST_F(ControlSnapshot, KnowsWhichControllersAreOff) {
    car_.switch_controller(0, false);
    write_checkpoint(path(), car_, {});
    Simulation other = panic_stop();
    read_checkpoint(path(), other);
    EXPECT_FALSE(other.control()->is_on(0, other.control_memory()));
    EXPECT_TRUE(other.control()->is_on(1, other.control_memory()));
    advance(other, 100), advance(car_, 100);
    expect_same_everything(other, car_);
    EXPECT_EQ(other.control()->activity(0, other.control_memory()), 0);
}

TEST_F(ControlSnapshot, IsRefusedForACarWithOtherControllers) {
    write_checkpoint(path(), car_, {});
    for (const char* off : {"abs", "esc", "all"}) {
        ScenarioDescription s = car_.scenario();
        s.controllers_off = {off};
        Simulation other(test::shipped("bmw_e90_330i"), s);
        EXPECT_NE(message_of(path(), other), "") << "without " << off;
        EXPECT_EQ(other.steps_taken(), 0);
    }
}

// Where a field stands in the file.
struct Offset {
    std::string_view wanted;
    std::size_t at = 0, found = 0;
    void add(std::string_view name, std::size_t size) {
        if (name == wanted) found = at;
        at += size;
    }
    void real(std::string_view name, const double&, Limits) { add(name, 8); }
    template <class Whole>
    void whole(std::string_view name, const Whole&, Limits) {
        add(name, 8);
    }
    template <class Choice>
    void choice(std::string_view name, const Choice&, std::span<const bool>) {
        add(name, 8);
    }
    void truth(std::string_view name, const bool&) { add(name, 1); }
    void state(std::string_view, const StateLayout& layout, std::span<const double>, Limits) {
        at += 8 * layout.numbers().size();
    }
};

TEST_F(ControlSnapshot, IsRefusedWithACommandBeyondItsLimits) {
    write_checkpoint(path(), car_, {});
    std::ifstream file(path(), std::ios::binary);
    const std::string whole(std::istreambuf_iterator<char>(file), {});
    const auto snapshot = std::make_unique<Snapshot>();
    car_.save(*snapshot);
    const auto message_with = [&](std::string_view name, double value) {
        constexpr std::size_t head = 16 + 24 + 24 + 8 + 8 + 8 + 8 + 4;  // before the first field
        Offset offset{.wanted = name, .at = head};
        visit_snapshot(std::as_const(*snapshot), SnapshotBounds(car_), offset);
        EXPECT_NE(offset.found, 0u) << name;
        std::string bytes = whole;
        std::memcpy(bytes.data() + offset.found, &value, sizeof value);
        const std::size_t summed = bytes.size() - sizeof(std::uint64_t);
        io::Checksum sum;
        sum.add(std::string_view(bytes).substr(0, summed));
        const std::uint64_t number = sum.value();
        std::memcpy(bytes.data() + summed, &number, sizeof number);
        std::ofstream(path("forged"), std::ios::binary) << bytes;
        Simulation other = panic_stop();
        return message_of(path("forged"), other);
    };
    EXPECT_THAT(message_with("front_left.brake.inlet", 1.5), HasSubstr("damaged: front_left.brake.inlet = 1.5"));
    EXPECT_THAT(message_with("rear_right.brake.outlet", -0.1), HasSubstr("damaged: rear_right.brake.outlet = -0.1"));
    EXPECT_THAT(message_with("front_right.brake.pump", std::nan("")),
                HasSubstr("damaged: front_right.brake.pump = nan"));
    EXPECT_THAT(message_with("controllers' memory", HUGE_VAL), HasSubstr("damaged: controllers' memory = inf"));
    EXPECT_THAT(message_with("commands", std::bit_cast<double>(std::int64_t{3})), HasSubstr("damaged: commands = 3"));
}

TEST_F(ControlSnapshot, DecidesWithoutAllocation) {
    const test::AllocationGuard guard;
    for (int i = 0; i < 100; ++i) EXPECT_FALSE(car_.advance());
    EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace hamilcar
