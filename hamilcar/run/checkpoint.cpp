// The file: a heading, what the run was made from, the numbers of a snapshot, the rates there, how the run went; a
// checksum of all of it at the end. It is read whole and believed only if the sum is right: a number changed on the
// disk would be a wrong result, or an index beyond a list.
#include "hamilcar/run/checkpoint.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>

#include "hamilcar/block/ring.hpp"
#include "hamilcar/io/checksum.hpp"
#include "hamilcar/io/error.hpp"

namespace hamilcar {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view heading = "hamilcar state 2";  // the number: of this layout
constexpr std::string_view kind = heading.substr(0, heading.size() - 1);
constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 30;

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

// Calls f with every number of a snapshot that a run goes on with.
template <class Access, class Snapshotted>
void visit_numbers(Snapshotted& snapshot, const Head& head, Access&& access) {
    access(snapshot.step_count);
    access(snapshot.state.values.data(), head.size);
    access(snapshot.memory.remembered), access(snapshot.memory.newest), access(snapshot.memory.substep);
    access(snapshot.memory.converged);
    for (int i = 0; i < head.order; ++i)
        access(snapshot.memory.past[static_cast<std::size_t>(i)].values.data(), head.size);
    access(snapshot.inputs), access(snapshot.driver);
}

class Writer {
public:
    template <class T>
    void add(const T& number) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    void add(const double* numbers, std::size_t count) {
        bytes_.append(reinterpret_cast<const char*>(numbers), count * sizeof(double));
    }
    void add(const std::vector<double>& numbers) {
        add(numbers.size());
        add(numbers.data(), numbers.size());
    }
    void add(std::string_view text) { bytes_.append(text); }
    std::string take() {
        io::Checksum sum;
        sum.add(bytes_);
        add(sum.value());
        return std::move(bytes_);
    }

private:
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
        static_assert(std::is_trivially_copyable_v<T>);
        read(reinterpret_cast<char*>(&number), sizeof number);
    }
    void take(double* numbers, std::size_t count) { read(reinterpret_cast<char*>(numbers), count * sizeof(double)); }
    void take(std::vector<double>& numbers) {
        std::size_t count = 0;
        take(count);
        if (count > rest_.size() / sizeof(double)) refuse_damaged();
        numbers.resize(count);
        take(numbers.data(), count);
    }
    void finish() const {
        if (!rest_.empty()) refuse_damaged();
    }
    [[noreturn]] void fail(const std::string& why) const {
        throw io::Error(io::ExitCode::bad_file, path_ + ": " + why);
    }

private:
    [[noreturn]] void refuse_damaged() const { fail("the checkpoint is damaged or cut off"); }
    void read(char* to, std::size_t bytes) {
        if (bytes > rest_.size()) refuse_damaged();
        if (bytes == 0) return;  // where an empty list has no place to copy to
        std::memcpy(to, rest_.data(), bytes);
        rest_.remove_prefix(bytes);
    }
    std::string_view rest_;
    std::string path_;
};

[[noreturn]] void refuse_to_write(const std::string& path, const std::string& why) {
    throw io::Error(io::ExitCode::input_output, fmt::format("{}: cannot write the checkpoint: {}", path, why));
}

// A mistyped name must not cost a scenario. An empty file has nothing to lose.
void check_place(const std::string& path) {
    std::error_code unknown;
    if (!fs::exists(path, unknown)) return;
    if (!fs::is_regular_file(path, unknown)) refuse_to_write(path, "not a regular file");
    std::ifstream file(path, std::ios::binary);
    std::string begins(kind.size(), '\0');
    file.read(begins.data(), static_cast<std::streamsize>(begins.size()));
    if (file.gcount() == 0 || begins == kind) return;
    throw io::Error(io::ExitCode::usage,
                    path + " is there and is no checkpoint: expected a new file, or an earlier checkpoint");
}

void put_in_place(const std::string& path, const std::string& bytes) {
    const std::string beside = path + ".part";
    std::ofstream file(beside, std::ios::binary);
    if (!file) refuse_to_write(path, std::strerror(errno));
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    std::error_code error;
    std::string why = file ? "" : std::strerror(errno);
    if (why.empty()) fs::rename(beside, path, error);
    if (error) why = error.message();
    if (why.empty()) return;
    fs::remove(beside, error);
    refuse_to_write(path, why);
}

std::string read_whole(const std::string& path) {
    std::error_code unknown;
    const bool there = fs::exists(path, unknown);
    if (there && !fs::is_regular_file(path, unknown)) {
        throw io::Error(io::ExitCode::input_output, path + ": cannot read: not a regular file");
    }
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        throw io::Error(io::ExitCode::input_output, fmt::format("{}: cannot read: {}", path, std::strerror(errno)));
    }
    const std::uintmax_t size = fs::file_size(path, unknown);
    if (size > most_bytes) throw io::Error(io::ExitCode::bad_file, path + ": too large for a checkpoint");
    std::string bytes(size, '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(size));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
}

// Rates of every number now. The same for the same vehicle, road and inputs; all parameters that matter are in them.
State<double> rates_of(const Simulation& simulation) {
    State<double> rate;
    evaluate(simulation.model(), simulation.schedule()(simulation.time()), simulation.state(), rate);
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

void write_checkpoint(const std::string& path, const Simulation& simulation, const Progressed& progressed,
                      const Origin& origin) {
    check_place(path);
    const auto snapshot = std::make_unique<Snapshot>();
    simulation.save(*snapshot);
    const Head head = head_of(simulation, origin);
    Writer file;
    const auto add = [&](const auto&... what) { file.add(what...); };
    file.add(heading);
    visit_head(head, add);
    visit_numbers(*snapshot, head, add);
    file.add(rates_of(simulation).values.data(), head.size);
    const RunSummary& s = progressed.summary;
    file.add(std::array<double, 4>{s.worst_opening, s.worst_energy_drift, s.largest_kinetic_energy, s.wall_time});
    file.add(progressed.x), file.add(progressed.y);
    put_in_place(path, file.take());
}

Progressed read_checkpoint(const std::string& path, Simulation& simulation, const Origin& origin) {
    const std::string bytes = read_whole(path);
    Reader file(bytes, path);
    const auto take = [&](auto&&... what) { file.take(what...); };
    const Head here = head_of(simulation, origin);
    Head its;
    visit_head(its, take);
    const std::vector<std::string> others = differences(its, here);
    if (!others.empty()) file.fail(fmt::format("the checkpoint is of another {}", fmt::join(others, ", ")));
    const auto snapshot = std::make_unique<Snapshot>();
    visit_numbers(*snapshot, here, take);
    State<double> rates;
    file.take(rates.values.data(), here.size);
    Progressed out;
    std::array<double, 4> figures{};
    file.take(figures);
    out.summary.worst_opening = figures[0], out.summary.worst_energy_drift = figures[1];
    out.summary.largest_kinetic_energy = figures[2], out.summary.wall_time = figures[3];
    file.take(out.x), file.take(out.y);
    file.finish();
    simulation.restore(*snapshot);
    const State<double> now = rates_of(simulation);
    if (!std::equal(now.values.begin(), now.values.begin() + static_cast<std::ptrdiff_t>(here.size),
                    rates.values.begin())) {
        file.fail("the checkpoint is of another vehicle or scenario: at that instant the rates are not the same");
    }
    return out;
}

}  // namespace hamilcar
