#include "hamilcar/program/portable.hpp"

#include <array>
#include <atomic>
#include <chrono>

#include "hamilcar/program/portable_code.hpp"

namespace hamilcar::program {

namespace {

using namespace portable;

struct alignas(64) CacheLine {
    std::byte bytes[64];
};

// Scratch memory of programs that need much. It allocates only when more threads run at once than ever before, so that all runs
// but each thread's first allocate nothing; recursive programs work, too.
class ScratchPool {
public:
    ScratchPool() = default;
    ~ScratchPool() {
        for (std::atomic<CacheLine*>& slot : slots_) delete[] slot.load();
    }
    ScratchPool(const ScratchPool&) = delete;
    ScratchPool& operator=(const ScratchPool&) = delete;

    CacheLine* take(std::size_t lines) {
        for (std::atomic<CacheLine*>& slot : slots_) {
            if (CacheLine* found = slot.exchange(nullptr)) return found;
        }
        return new CacheLine[lines];
    }
    void put_back(CacheLine* memory) noexcept {
        for (std::atomic<CacheLine*>& slot : slots_) {
            CacheLine* empty = nullptr;
            if (slot.compare_exchange_strong(empty, memory)) return;
        }
        delete[] memory;
    }

private:
    std::array<std::atomic<CacheLine*>, 64> slots_{};
};

template <class Number>
class Portable final : public Executable {
public:
    Portable(const Graph& graph, int lanes)
        : Executable(graph.precision(), lanes), code_(translated<Number>(graph, lanes)) {
        const std::size_t bytes = code_.scratch_numbers * sizeof(Number);
        entry_ = bytes <= small ? run_on_stack<small> : bytes <= large ? run_on_stack<large> : run_on_pool;
        report_.instructions = code_.operations.size();
        report_.code_bytes = code_.operations.size() * sizeof(Operation) + code_.groups.size() * sizeof(Group<Number>) +
                             code_.steps.size() * sizeof(Step);
        report_.constant_bytes = code_.constants.size() * sizeof(Number);
        report_.scratch_bytes = bytes;
        if (bytes > large) pool_.put_back(pool_.take(lines()));  // for the first thread
    }

    void set_seconds(double seconds) { report_.seconds = seconds; }

private:
    static constexpr std::size_t small = 16 << 10, large = 128 << 10;
    std::size_t lines() const { return (report_.scratch_bytes + sizeof(CacheLine) - 1) / sizeof(CacheLine); }

    template <std::size_t size>
    static void run_on_stack(const Executable& self, const Frame& frame) {
        alignas(64) Number scratch[size / sizeof(Number)];
        static_cast<const Portable&>(self).code_.walk(frame, scratch);
    }
    static void run_on_pool(const Executable& self, const Frame& frame) {
        const auto& program = static_cast<const Portable&>(self);
        CacheLine* memory = program.pool_.take(program.lines());
        program.code_.walk(frame, reinterpret_cast<Number*>(memory));
        program.pool_.put_back(memory);
    }

    Code<Number> code_;
    mutable ScratchPool pool_;
};

template <class Number>
std::unique_ptr<Executable> compiled(const Graph& graph, bool car_in_each_lane) {
    const auto begin = std::chrono::steady_clock::now();
    auto program =
        std::make_unique<Portable<Number>>(graph, car_in_each_lane ? static_cast<int>(64 / sizeof(Number)) : 1);
    program->set_seconds(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    return program;
}

}  // namespace

std::unique_ptr<Executable> compile_portable(const Graph& graph, bool car_in_each_lane) {
    return graph.precision() == Precision::double_precision ? compiled<double>(graph, car_in_each_lane)
                                                            : compiled<float>(graph, car_in_each_lane);
}

}  // namespace hamilcar::program
