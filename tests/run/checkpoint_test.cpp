// Going on from a file, in a simulation that was made anew, to the same bits.
#include "hamilcar/run/checkpoint.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <tuple>
#include <utility>

#include "hamilcar/io/checksum.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/run/checkpoint_fields.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

using testing::HasSubstr;

class Checkpoint : public testing::Test {
protected:
    Checkpoint()
        : folder_(std::filesystem::temp_directory_path() / ("hamilcar_checkpoint_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_);
    }
    ~Checkpoint() override { std::filesystem::remove_all(folder_); }
    std::string path(const char* name = "state") const { return (folder_ / name).string(); }
    // No half of a file beside it.
    bool is_alone() const {
        return std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()) == 1;
    }

private:
    std::filesystem::path folder_;
};

// A driver on a bent path who shifts and holds a speed.
ScenarioDescription driven() {
    ScenarioDescription s = test::scenario(6, 8);
    s.driver.steering.emplace();
    s.driver.steering->path.points = {{0, 0}, {40, 0}, {80, 6}, {140, 6}, {200, 0}};
    s.driver.speed.emplace();
    s.driver.speed->speed = {{0, 6}, {8, 20}, Interpolation::linear};
    s.driver.shifting.emplace();
    return s;
}

void expect_same(const Simulation& a, const Simulation& b) {
    ASSERT_EQ(a.steps_taken(), b.steps_taken());
    for (int i = 0; i < a.model().vehicle.state_size; ++i) {
        const auto k = static_cast<std::size_t>(i);
        ASSERT_EQ(a.state().values[k], b.state().values[k]) << i;
    }
}

TEST_F(Checkpoint, GoesOnToTheSameBitsWithADriver) {
    for (const char* method : {"ab3", "rk4", "dopri5"}) {
        ScenarioDescription s = driven();
        if (!find_method(method)) continue;
        s.solver.integrator = method;
        Simulation whole(test::shipped_car(), s), first(test::shipped_car(), s);
        for (int i = 0; i < 1503; ++i) ASSERT_FALSE(first.advance());  // between two decisions
        write_checkpoint(path(), first, {});
        Simulation second(test::shipped_car(), s);
        read_checkpoint(path(), second);
        expect_same(first, second);
        test::run_to_end(whole);
        test::run_to_end(second);
        expect_same(whole, second);
    }
}

TEST_F(Checkpoint, KeepsHowTheRunWent) {
    Simulation car(test::shipped_car(), driven());
    for (int i = 0; i < 3; ++i) ASSERT_FALSE(car.advance());
    Progressed so_far;
    so_far.summary.worst_opening = 1e-9, so_far.summary.largest_kinetic_energy = 5e4;
    so_far.x = {1, 2, 3}, so_far.y = {4, 5, 6};
    write_checkpoint(path(), car, so_far);
    const Progressed read = read_checkpoint(path(), car);
    EXPECT_EQ(read.summary.worst_opening, 1e-9);
    EXPECT_EQ(read.summary.largest_kinetic_energy, 5e4);
    EXPECT_EQ(read.y, so_far.y);
    EXPECT_TRUE(is_alone());
}

std::string message_of(const std::string& path, Simulation& car, const Origin& origin = {}) {
    try {
        read_checkpoint(path, car, origin);
    } catch (const io::Error& error) {
        return error.what();
    }
    return "";
}

TEST_F(Checkpoint, IsRefusedForAnotherCarOrScenario) {
    Simulation car(test::shipped_car(), driven());
    for (int i = 0; i < 100; ++i) ASSERT_FALSE(car.advance());
    write_checkpoint(path(), car, {}, {.vehicle = 1, .scenario = 2});
    VehicleDescription stiffer = test::shipped_car();
    stiffer.suspensions[0].springs[0].spring.rate *= 1.001;
    ScenarioDescription finer = driven(), slippery = driven(), other_method = driven();
    finer.solver.step = 5e-4, slippery.road.friction = 0.9, other_method.solver.integrator = "rk4";
    const Origin same{.vehicle = 1, .scenario = 2};
    for (const auto& [vehicle, scenario, what] :
         std::vector<std::tuple<VehicleDescription, ScenarioDescription, const char*>>{
             {stiffer, driven(), "the rates are not the same"},
             {test::shipped_car(), slippery, "the rates are not the same"},
             {test::shipped_car(), finer, "of another step (0.001 s)"},
             {test::shipped_car(), other_method, "of another method (ab3)"}}) {
        Simulation other(vehicle, scenario);
        EXPECT_THAT(message_of(path(), other, same), HasSubstr(what));
    }
    EXPECT_THAT(message_of(path(), car, {.vehicle = 3, .scenario = 2}), HasSubstr("of another vehicle"));
    EXPECT_THAT(message_of(path(), car, {.vehicle = 3, .scenario = 4}), HasSubstr("of another vehicle, scenario"));
    EXPECT_EQ(message_of(path(), car, same), "");
}

TEST_F(Checkpoint, IsRefusedWhereverItIsDamaged) {
    Simulation car(test::shipped_car(), driven());
    for (int i = 0; i < 100; ++i) ASSERT_FALSE(car.advance());
    write_checkpoint(path(), car, {{}, {1, 2}, {3, 4}});
    std::ifstream file(path(), std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(file), {}};
    const auto put = [&](const std::string& bytes) { std::ofstream(path("bad"), std::ios::binary) << bytes; };
    for (std::size_t i = 0; i < whole.size(); i += i < 128 ? 1 : 997) {
        for (const char damage : {'\x01', '\x80', '\xff'}) {
            std::string bytes = whole;
            bytes[i] = static_cast<char>(bytes[i] ^ damage);
            put(bytes);
            ASSERT_NE(message_of(path("bad"), car), "") << i;
        }
        put(whole.substr(0, i));
        ASSERT_NE(message_of(path("bad"), car), "") << "cut off at " << i;
    }
    put(whole + "more");
    EXPECT_THAT(message_of(path("bad"), car), HasSubstr("damaged or cut off"));
    put("no checkpoint at all");
    EXPECT_THAT(message_of(path("bad"), car), HasSubstr("expected a checkpoint"));
    put("hamilcar state 1, of an earlier layout");
    EXPECT_THAT(message_of(path("bad"), car), HasSubstr("of another version"));
    EXPECT_NE(message_of(path("missing"), car), "");
    EXPECT_NE(message_of(path("."), car), "");
    put(whole);
    EXPECT_EQ(message_of(path("bad"), car), "");
}

TEST_F(Checkpoint, TakesThePlaceOfNothingElse) {
    Simulation car(test::shipped_car(), driven());
    EXPECT_THROW(write_checkpoint("/nowhere/at/all", car, {}), io::Error);
    EXPECT_THROW(write_checkpoint(path("."), car, {}), io::Error);
    std::ofstream(path("scenario.toml")) << "name = \"precious\"\n";
    EXPECT_THROW(write_checkpoint(path("scenario.toml"), car, {}), io::Error);
    EXPECT_EQ(std::filesystem::file_size(path("scenario.toml")), 18u);
    EXPECT_TRUE(is_alone());
    std::ofstream(path("empty")).close();
    write_checkpoint(path("empty"), car, {});
    write_checkpoint(path("empty"), car, {});
}

// Walks the fields as the writer does, and notes where each one stands in the file.
class Offsets {
public:
    struct Field {
        std::string name;
        std::size_t at;
        Limits limits;
        enum class Kind { real, whole, truth } kind;
    };
    explicit Offsets(std::size_t begin) : at_(begin) {}
    void real(std::string_view name, const double&, Limits limits) { add(name, 8, limits, Field::Kind::real); }
    template <class Whole>
    void whole(std::string_view name, const Whole&, Limits limits) {
        add(name, 8, limits, Field::Kind::whole);
    }
    template <class Choice>
    void choice(std::string_view name, const Choice&, std::span<const bool> allowed) {
        add(name, 8, {0, static_cast<double>(allowed.size() - 1)}, Field::Kind::whole);
    }
    void truth(std::string_view name, const bool&) { add(name, 1, {0, 1}, Field::Kind::truth); }
    void row(std::string_view name, std::span<const double> numbers, Limits limits) {
        for (std::size_t i = 0; i < numbers.size(); ++i) add(name, 8, limits, Field::Kind::real);
    }
    const std::vector<Field>& fields() const { return fields_; }

private:
    void add(std::string_view name, std::size_t size, Limits limits, Field::Kind kind) {
        fields_.push_back({std::string(name), at_, limits, kind});
        at_ += size;
    }
    std::size_t at_;
    std::vector<Field> fields_;
};

// Checkpoints that somebody made: a right checksum, and one number otherwise.
class ForgedCheckpoint : public Checkpoint {
protected:
    ForgedCheckpoint() : car_(test::shipped_car(), driven()) {
        for (int i = 0; i < 1503; ++i) EXPECT_FALSE(car_.advance());
        write_checkpoint(path(), car_, {{}, {1, 2}, {3, 4}});
        std::ifstream file(path(), std::ios::binary);
        whole_ = {std::istreambuf_iterator<char>(file), {}};
    }
    // With `value` at `offset`, and its sum made anew.
    template <class Value>
    std::string message_with(std::size_t offset, Value value) {
        std::string bytes = whole_;
        std::memcpy(bytes.data() + offset, &value, sizeof value);
        const std::size_t summed = bytes.size() - sizeof(std::uint64_t);
        io::Checksum sum;
        sum.add(std::string_view(bytes).substr(0, summed));
        const std::uint64_t number = sum.value();
        std::memcpy(bytes.data() + summed, &number, sizeof number);
        std::ofstream(path("forged"), std::ios::binary) << bytes;
        return message_of(path("forged"), car_);
    }
    // Behind the heading: version, method, step, two checksums, size, order.
    static constexpr std::size_t fields_begin = 16 + 2 * 24 + 8 + 2 * 8 + 8 + 4;

    Simulation car_;
    std::string whole_;
};

TEST_F(ForgedCheckpoint, IsRefusedWithAnyFieldBeyondItsLimits) {
    const auto snapshot = std::make_unique<Snapshot>();
    car_.save(*snapshot);
    Offsets places(fields_begin);
    visit_snapshot(std::as_const(*snapshot), SnapshotBounds(car_), places);
    ASSERT_GT(places.fields().size(), 200u);
    for (const Offsets::Field& field : places.fields()) {
        const auto refused = testing::HasSubstr("damaged: " + field.name + " = ");
        if (field.kind == Offsets::Field::Kind::truth) {
            for (const std::uint8_t no_truth : {2, 255}) EXPECT_THAT(message_with(field.at, no_truth), refused);
        } else if (field.kind == Offsets::Field::Kind::whole) {
            const auto least = static_cast<std::int64_t>(field.limits.least),
                       most = static_cast<std::int64_t>(field.limits.most);
            for (const std::int64_t beyond :
                 {least - 1, least - 3, most + 1, most + 1'000'000, std::numeric_limits<std::int64_t>::min(),
                  std::numeric_limits<std::int64_t>::max()}) {
                EXPECT_THAT(message_with(field.at, beyond), refused);
            }
        } else {
            EXPECT_THAT(message_with(field.at, std::nan("")), refused);
            for (const double beyond : {1e300, std::numeric_limits<double>::infinity()}) {
                if (beyond <= field.limits.most) continue;
                EXPECT_THAT(message_with(field.at, beyond), refused);
            }
        }
    }
}

// What was once taken in silence, or wrote to where it pointed: a car of five gears, a scenario that nothing ends.
TEST_F(ForgedCheckpoint, IsRefusedWithNumbersThatReachedMemory) {
    const auto snapshot = std::make_unique<Snapshot>();
    car_.save(*snapshot);
    Offsets places(fields_begin);
    visit_snapshot(std::as_const(*snapshot), SnapshotBounds(car_), places);
    const auto forge = [&](const std::string& name, auto value) {
        const auto field = std::ranges::find(places.fields(), name, &Offsets::Field::name);
        EXPECT_NE(field, places.fields().end()) << name;
        EXPECT_THAT(message_with(field->at, value), HasSubstr("damaged: " + name + " = ")) << value;
    };
    constexpr auto most = std::numeric_limits<std::int64_t>::max(), least = std::numeric_limits<std::int64_t>::min();
    for (const std::int64_t wrong : {-1000L, -5L, -4L, -3L, -1L, 3L, 4L, 1'000'000L, most, least}) {
        forge("memory.newest", wrong), forge("memory.remembered", wrong == 3 ? 2L : wrong);
    }
    for (const std::int64_t gear : {-1L, 0L, 7L, 100L, 1'000'000L, most, least}) {
        forge("driver.shifting.gear", gear), forge("driver.shifting.next", gear);
    }
    for (const std::int64_t phase : {-1L, 4L, 77L}) forge("driver.shifting.phase", phase);
    for (const std::int64_t reason : {-1L, 1L, 7L, 8L}) forge("driver.ending.reason", reason);
    for (const std::int64_t count : {-1L, 1502L, 1504L, 2'000'000'000L}) {
        EXPECT_THAT(message_with(fields_begin, count), HasSubstr("damaged: "));
    }
    forge("state.position", 1e300), forge("driver.path.station", 1e300), forge("memory.substep", std::nan(""));
}

TEST_F(ForgedCheckpoint, IsRefusedOrHarmlessWhereverItIsForged) {
    const Simulation before = car_;
    int taken = 0;
    for (std::size_t at = 0; at + 16 < whole_.size(); ++at) {
        for (const std::uint64_t word : {0x4141414141414140u, ~std::uint64_t{3}, std::uint64_t{7}}) {
            car_ = before;
            if (!message_with(at, word).empty()) {
                expect_same(before, car_);  // nothing was written
                continue;
            }
            ++taken;
            for (int i = 0; i < 10 && !car_.finished(); ++i) {
                if (car_.advance()) break;
            }
        }
    }
    EXPECT_GT(taken, 0);
}

TEST_F(ForgedCheckpoint, HasTextsThatEnd) {
    constexpr std::size_t version = 16, method = 16 + 24;
    for (const std::size_t place : {version, method}) {
        std::array<char, 24> endless, escape{"\x1b]0;owned\x07"};
        endless.fill('A');
        EXPECT_THAT(message_with(place, endless), HasSubstr("damaged or cut off"));
        EXPECT_THAT(message_with(place, escape), HasSubstr("damaged or cut off"));
    }
}

TEST_F(ForgedCheckpoint, HasAPathOfAsManyPointsEachWay) {
    const std::size_t x_count = whole_.size() - 8 - 2 * (8 + 2 * 8);
    EXPECT_THAT(message_with(x_count, std::uint64_t{1'000'000'000}), HasSubstr("damaged"));
    EXPECT_THAT(message_with(x_count + 8, std::nan("")), HasSubstr("the path's x = nan"));
}

}  // namespace
}  // namespace hamilcar
