// The file: a heading, what the run was made from, the numbers of a snapshot, the rates there, how the run went; a
// checksum of all of it at the end. The sum tells of a disk's mistakes, not of a person's: every field is held against the
// vehicle and the method besides, before the simulation is touched.
#include "hamilcar/run/checkpoint.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <memory>
#include <span>

#include "hamilcar/block/rhs.hpp"
#include "hamilcar/io/checksum.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/whole_file.hpp"
#include "hamilcar/run/checkpoint_fields.hpp"
#include "hamilcar/run/validity.hpp"

namespace hamilcar {

namespace {

constexpr std::string_view heading = "hamilcar state 6";  // the number: of this layout
constexpr std::string_view kind = heading.substr(0, heading.size() - 1);

using Word = std::array<char, 24>;

Word word_of(std::string_view text) {
    Word word{};
    text.copy(word.data(), word.size() - 1);
    return word;
}

// What must be the same where a run goes on.
struct Head {
    Word version, method;
    double step = 0;  // [s]
    Origin origin;
    std::size_t size = 0;  // of the state
    int order = 0;         // past rates that the method remembers
};

template <class Access, class SomeHead>
void visit_head(SomeHead& head, Access&& access) {
    access(head.version), access(head.method), access(head.step);
    access(head.origin.vehicle), access(head.origin.scenario);
    access(head.size), access(head.order);
}

Head head_of(const Simulation& simulation, const Origin& origin) {
    const SolverDescription& solver = simulation.scenario().solver;
    return {.version = word_of(HAMILCAR_VERSION),
            .method = word_of(solver.integrator),
            .step = solver.step,
            .origin = origin,
            .size = static_cast<std::size_t>(simulation.model().vehicle.state_size),
            .order = std::min(find_method(solver.integrator)->order, max_adams_order)};
}

class Writer {
public:
    template <class T>
    void add(const T& number) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    void add(const std::vector<double>& numbers) {
        add(numbers.size());
        add_row(numbers);
    }
    void add(std::string_view text) { bytes_.append(text); }

    // The fields of a snapshot (checkpoint_fields.hpp).
    void real(std::string_view, const double& number, Limits) { add(number); }
    template <class Whole>
    void whole(std::string_view, const Whole& number, Limits) {
        add(static_cast<std::int64_t>(number));
    }
    template <class Choice>
    void choice(std::string_view, const Choice& one, std::span<const bool>) {
        add(static_cast<std::int64_t>(one));
    }
    void truth(std::string_view, const bool& yes) { add(static_cast<std::uint8_t>(yes)); }
    void state(std::string_view, const StateLayout&, std::span<const double> numbers, Limits) { add_row(numbers); }

    std::string take() {
        io::Checksum sum;
        sum.add(bytes_);
        add(sum.value());
        return std::move(bytes_);
    }

private:
    void add_row(std::span<const double> numbers) {
        bytes_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
    }
    std::string bytes_;
};

class Reader {
public:
    // Of a whole file: what stands before the checksum.
    Reader(std::string_view bytes, const std::string& path) : path_(path) {
        if (!bytes.starts_with(kind)) {
            fail("expected a checkpoint, a file that 'hamilcar run --checkpoint' wrote");
        }
        if (!bytes.starts_with(heading)) fail("the checkpoint is of another version of hamilcar");
        std::uint64_t written = 0;
        if (bytes.size() < heading.size() + sizeof written) refuse_damaged();
        rest_ = bytes.substr(0, bytes.size() - sizeof written);
        std::memcpy(&written, bytes.data() + rest_.size(), sizeof written);
        io::Checksum sum;
        sum.add(rest_);
        if (sum.value() != written) refuse_damaged();
        rest_.remove_prefix(heading.size());
    }
    template <class T>
    void take(T& number) {
        static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool> && !std::is_enum_v<T>);
        read(reinterpret_cast<char*>(&number), sizeof number);
    }
    // A text that ends within its place, and nothing that a terminal would obey.
    void take(Word& word) {
        read(word.data(), word.size());
        const std::string_view text(word.data(), word.size());
        const std::size_t end = text.find('\0');
        const auto odd = [](char c) { return c < ' ' || c > '~'; };
        if (end == text.npos || std::ranges::any_of(text.substr(0, end), odd)) refuse_damaged();
    }
    void take(std::string_view name, std::vector<double>& numbers) {
        std::size_t count = 0;
        take(count);
        if (count > rest_.size() / sizeof(double)) refuse_damaged();
        numbers.resize(count);
        read_row(numbers);
        for (const double number : numbers) expect(name, number, any_finite);
    }

    // The fields of a snapshot, each within its limits whatever the checksum says: anybody can compute one.
    void real(std::string_view name, double& number, Limits limits) {
        take(number);
        expect(name, number, limits);
    }
    template <class Whole>
    void whole(std::string_view name, Whole& number, Limits limits) {
        std::int64_t value = 0;
        take(value);
        expect(name, static_cast<double>(value), limits);
        number = static_cast<Whole>(value);
    }
    template <class Choice>
    void choice(std::string_view name, Choice& one, std::span<const bool> allowed) {
        whole(name, one, {0, static_cast<double>(allowed.size() - 1)});
        if (allowed[static_cast<std::size_t>(one)]) return;
        fail(fmt::format("the checkpoint is damaged: {} = {}: expected one that the scenario has", name,
                         static_cast<int>(one)));
    }
    void truth(std::string_view name, bool& yes) {
        std::uint8_t value = 0;
        take(value);
        expect(name, value, {0, 1});
        yes = value == 1;
    }
    void state(std::string_view name, const StateLayout& layout, std::span<double> numbers, Limits position) {
        read_row(numbers);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const StateNumber& one = layout.numbers()[i];
            const Limits& limits = one.kind == StateKind::position ? position : any_finite;
            if (!within(numbers[i], limits)) expect(fmt::format("{}.{}", name, one.name), numbers[i], limits);
        }
    }

    void finish() const {
        if (!rest_.empty()) refuse_damaged();
    }
    [[noreturn]] void fail(const std::string& why) const {
        throw io::Error(io::ExitCode::bad_file, path_ + ": " + why);
    }

private:
    [[noreturn]] void refuse_damaged() const { fail("the checkpoint is damaged or cut off"); }
    static bool within(double value, const Limits& limits) { return value >= limits.min && value <= limits.max; }
    void expect(std::string_view name, double value, Limits limits) const {
        if (within(value, limits)) return;
        const bool bounded = limits.max < any_finite.max;
        const std::string expected = bounded && limits.min == limits.max ? fmt::format("{:g}", limits.min)
                                     : bounded         ? fmt::format("{:g} to {:g}", limits.min, limits.max)
                                     : limits.min == 0 ? "a finite number not below zero"
                                                       : "a finite number";
        fail(fmt::format("the checkpoint is damaged: {} = {:g}: expected {}", name, value, expected));
    }
    void read_row(std::span<double> numbers) { read(reinterpret_cast<char*>(numbers.data()), numbers.size_bytes()); }
    void read(char* to, std::size_t bytes) {
        if (bytes > rest_.size()) refuse_damaged();
        if (bytes == 0) return;  // where an empty list has no place to copy to
        std::memcpy(to, rest_.data(), bytes);
        rest_.remove_prefix(bytes);
    }
    std::string_view rest_;
    std::string path_;
};

// A mistyped name must not cost a scenario. An empty file has nothing to lose.
void check_place(const std::string& path) {
    io::expect_writable_place(path);
    const std::string begins = io::file_beginning(path, kind.size());
    if (begins.empty() || begins == kind) return;
    throw io::Error(io::ExitCode::usage,
                    path + " is there and is no checkpoint: expected a new file, or an earlier checkpoint");
}

// Rates of every number now. The same for the same vehicle, road and inputs; all parameters that matter are in them.
State<double> rates_of(const Simulation& simulation) {
    State<double> rate;
    evaluate_rhs(simulation.model(), simulation.schedule()(simulation.time()), simulation.state(), rate);
    return rate;
}

// What the checkpoint has otherwise than the run that is to go on, in words.
std::vector<std::string> differences(const Head& its, const Head& here) {
    if (its.version != here.version) return {fmt::format("version of hamilcar ({})", its.version.data())};
    std::vector<std::string> out;
    if (its.origin.vehicle != here.origin.vehicle) out.emplace_back("vehicle");
    if (its.origin.scenario != here.origin.scenario) out.emplace_back("scenario");
    if (its.method != here.method) out.push_back(fmt::format("method ({})", its.method.data()));
    if (its.step != here.step) out.push_back(fmt::format("step ({:g} s)", its.step));
    if (out.empty() && (its.size != here.size || its.order != here.order)) out.emplace_back("vehicle");
    return out;
}

}  // namespace

SnapshotBounds::SnapshotBounds(const Simulation& simulation)
    : layout(simulation.vehicle()),
      step(simulation.scenario().solver.step),
      commands(simulation.vehicle()),
      control_memory(simulation.control_memory().size()) {
    const Method& method = *find_method(simulation.scenario().solver.integrator);
    order = std::min(method.order, max_adams_order);
    is_multi_step =
        method.family == MethodFamily::adams_bashforth || method.family == MethodFamily::adams_bashforth_moulton;
    using Reason = EndingMemory::Reason;
    const EndingDescription& ends = simulation.scenario().driver.ending;
    const auto allow = [this](Reason reason, bool yes) { endings[static_cast<std::size_t>(reason)] = yes; };
    allow(Reason::none, true), allow(Reason::speed_below, ends.speed_below.has_value());
    allow(Reason::speed_above, ends.speed_above.has_value()), allow(Reason::distance, ends.distance.has_value());
    allow(Reason::station, ends.station.has_value()), allow(Reason::path_offset, ends.path_offset.has_value());
    allow(Reason::lateral_acceleration, ends.lateral_acceleration.has_value());
    allow(Reason::roll, ends.roll.has_value());
    const auto& shifting = simulation.scenario().driver.shifting;
    const int gears = simulation.driven_car().gears;
    if (!shifting || gears == 0) return;
    lowest_gear = shifting->gear.value_or(1);
    highest_gear = shifting->gear.value_or(gears);
}

void write_checkpoint(const std::string& path, const Simulation& simulation, const Progressed& progressed,
                      const Origin& origin) {
    check_place(path);
    const auto snapshot = std::make_unique<Snapshot>();
    simulation.save(*snapshot);
    const Head head = head_of(simulation, origin);
    Writer file;
    file.add(heading);
    visit_head(head, [&](const auto& what) { file.add(what); });
    visit_snapshot(*snapshot, SnapshotBounds(simulation), file);
    const State<double> rates = rates_of(simulation);
    file.state("rates", StateLayout(simulation.vehicle()), {rates.values.data(), head.size}, any_finite);
    visit_figures(progressed.summary, file);
    file.add(progressed.summary.validity_marks);
    file.add(progressed.x), file.add(progressed.y);
    io::write_whole_file(path, {file.take()});
}

Progressed read_checkpoint(const std::string& path, Simulation& simulation, const Origin& origin) {
    const std::string bytes = io::read_whole_file(path, io::FileLimit::checkpoint);
    Reader file(bytes, path);
    const Head here = head_of(simulation, origin);
    Head its;
    visit_head(its, [&](auto& what) { file.take(what); });
    const std::vector<std::string> others = differences(its, here);
    if (!others.empty()) file.fail(fmt::format("the checkpoint is of another {}", fmt::join(others, ", ")));
    const auto snapshot = std::make_unique<Snapshot>();
    visit_snapshot(*snapshot, SnapshotBounds(simulation), file);
    State<double> rates;
    file.state("rates", StateLayout(simulation.vehicle()), {rates.values.data(), here.size}, any_finite);
    Progressed out;
    visit_figures(out.summary, file);
    file.take("what limits its validity", out.summary.validity_marks);
    if (!ValidityMonitor::fit(simulation, out.summary.validity_marks)) {
        file.fail("the checkpoint is damaged: what it says of the run's validity belongs to no such run");
    }
    file.take("the path's x", out.x), file.take("the path's y", out.y);
    if (out.x.size() != out.y.size()) file.fail("the checkpoint is damaged: its path has more x than y, or fewer");
    file.finish();

    const auto before = std::make_unique<Snapshot>();
    simulation.save(*before);
    simulation.restore(*snapshot);
    const State<double> now = rates_of(simulation);
    if (!std::equal(now.values.begin(), now.values.begin() + static_cast<std::ptrdiff_t>(here.size),
                    rates.values.begin())) {
        simulation.restore(*before);
        file.fail("the checkpoint is of another vehicle or scenario: at that instant the rates are not the same");
    }
    return out;
}

}  // namespace hamilcar
