// Checkpoints that somebody forged: a right checksum, and numbers that no run has.
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <utility>

#include "hamilcar/io/checksum.hpp"
#include "hamilcar/run/checkpoint_fields.hpp"
#include "run/checkpoint_folder.hpp"

namespace hamilcar {
namespace {

using testing::HasSubstr;

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
    void state(std::string_view name, const StateLayout& layout, std::span<const double> numbers, Limits position) {
        ASSERT_EQ(numbers.size(), layout.numbers().size());
        for (const StateNumber& one : layout.numbers()) {
            const bool bounded = one.kind == StateKind::position;
            add(std::string(name) + "." + one.name, 8, bounded ? position : any_finite, Field::Kind::real);
        }
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
    ForgedCheckpoint() : car_(test::shipped_car(), test::driven()) {
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
    // The heading, then version, method, step, two checksums, size, order.
    static constexpr std::size_t version_at = 16, method_at = version_at + 24, step_at = method_at + 24,
                                 vehicle_at = step_at + 8, scenario_at = vehicle_at + 8, size_at = scenario_at + 8,
                                 order_at = size_at + 8, fields_begin = order_at + 4;

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
            const auto min = static_cast<std::int64_t>(field.limits.min),
                       max = static_cast<std::int64_t>(field.limits.max);
            for (const std::int64_t beyond :
                 {min - 1, min - 3, max + 1, max + 1'000'000, std::numeric_limits<std::int64_t>::min(),
                  std::numeric_limits<std::int64_t>::max()}) {
                EXPECT_THAT(message_with(field.at, beyond), refused);
            }
        } else {
            EXPECT_THAT(message_with(field.at, std::nan("")), refused);
            for (const double beyond : {1e300, std::numeric_limits<double>::infinity()}) {
                if (beyond <= field.limits.max) continue;
                EXPECT_THAT(message_with(field.at, beyond), refused);
            }
        }
    }
}

// What stands before and behind the snapshot: what it was made from, the rates, how the run went.
TEST_F(ForgedCheckpoint, IsRefusedAsOfAnotherRun) {
    const auto word = [](const char* text) {
        std::array<char, 24> chars{};
        std::strncpy(chars.data(), text, chars.size() - 1);
        return chars;
    };
    EXPECT_THAT(message_with(version_at, word("0.0.1")), HasSubstr("of another version of hamilcar (0.0.1)"));
    EXPECT_THAT(message_with(method_at, word("rk4")), HasSubstr("of another method (rk4)"));
    EXPECT_THAT(message_with(method_at, word("no method")), HasSubstr("of another method (no method)"));
    for (const double step : {0.002, 0.0, -1e-3, 1e300, std::nan("")}) {
        EXPECT_THAT(message_with(step_at, step), HasSubstr("of another step"));
    }
    EXPECT_THAT(message_with(vehicle_at, std::uint64_t{7}), HasSubstr("of another vehicle"));
    EXPECT_THAT(message_with(scenario_at, std::uint64_t{7}), HasSubstr("of another scenario"));
    for (const std::uint64_t size : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
        EXPECT_THAT(message_with(size_at, size), HasSubstr("of another vehicle"));
    }
    for (const std::int32_t order : {-1, 0, 2, 4, 1'000'000}) {
        EXPECT_THAT(message_with(order_at, order), HasSubstr("of another vehicle"));
    }
}

TEST_F(ForgedCheckpoint, IsRefusedWithOtherRatesOrFigures) {
    const auto snapshot = std::make_unique<Snapshot>();
    car_.save(*snapshot);
    Offsets places(fields_begin);
    visit_snapshot(std::as_const(*snapshot), SnapshotBounds(car_), places);
    const std::size_t rates = places.fields().size();
    const StateLayout layout(car_.vehicle());
    places.state("rates", layout, {snapshot->state.values.data(), layout.numbers().size()}, any_finite);
    const std::size_t figures = places.fields().size();
    const RunSummary as_written{};
    visit_figures(as_written, places);
    const std::vector<Offsets::Field> fields = places.fields();
    for (std::size_t i = rates; i < figures; ++i) {
        EXPECT_THAT(message_with(fields[i].at, std::nan("")), HasSubstr("damaged: " + fields[i].name + " = nan"));
        EXPECT_THAT(message_with(fields[i].at, 1.2345e6), HasSubstr("the rates are not the same")) << fields[i].name;
    }
    ASSERT_GE(fields.size(), figures + 5);
    for (std::size_t i = figures; i < fields.size(); ++i) {
        const auto refused = HasSubstr("damaged: " + fields[i].name + " = ");
        if (fields[i].kind == Offsets::Field::Kind::truth) {
            EXPECT_THAT(message_with(fields[i].at, std::uint8_t{2}), refused);
        } else {
            for (const double wrong : {std::nan(""), -1.0, -std::numeric_limits<double>::infinity()}) {
                EXPECT_THAT(message_with(fields[i].at, wrong), refused);
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
    forge("state.position.y", 1e300), forge("state.rear_right.brake_windup", std::nan("")),
        forge("driver.path.station", 1e300), forge("memory.substep", std::nan(""));
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
    for (const std::size_t place : {version_at, method_at}) {
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
