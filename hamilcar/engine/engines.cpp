#include "hamilcar/engine/engines.hpp"

#include <fmt/format.h>

#include <atomic>
#include <stdexcept>

namespace hamilcar {

namespace {

struct Found {
    std::vector<const Engine*> engines;
    std::string refused;
};

// Whether the system permits generated code shows only when code is generated.
Found find_engines() {
    Found found;
    program::Graph smallest;
    smallest.output(1, 0, smallest.input(0, 0));
    for (const Engine& one : program::backends()) {
        if (!one.is_available()) continue;
        try {
            one.compile(smallest, false);
            found.engines.push_back(&one);
        } catch (const std::runtime_error& refusal) {
            found.refused = refusal.what();
        }
    }
    return found;
}

const Found& found() {
    static const Found once = find_engines();
    return once;
}

std::atomic<const Engine*>& chosen() {
    static std::atomic<const Engine*> one{found().engines.front()};
    return one;
}

}  // namespace

const std::vector<const Engine*>& engines() {
    return found().engines;
}

const Engine& engine(std::string_view name) {
    std::string here;
    for (const Engine* one : engines()) {
        if (one->name == name) return *one;
        here += (here.empty() ? "" : ", ") + std::string(one->name);
    }
    throw std::invalid_argument(fmt::format("engine \"{}\": expected one that this machine supports: {}", name, here));
}

const Engine& default_engine() {
    return *chosen();
}

void choose_default_engine(std::string_view name) {
    chosen() = &engine(name);
}

const std::string& refused_engines() {
    return found().refused;
}

}  // namespace hamilcar
