#include "hamilcar/engine/library.hpp"

#if defined(__x86_64__)
#include <cpuid.h>
#endif
#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <stdexcept>

namespace hamilcar {

namespace {

#if defined(__x86_64__)
// MOVBE, F16C and LZCNT, for which not every compiler's builtin has a name.
bool has_rest_of_v3() {
    unsigned a = 0, b = 0, c = 0, d = 0;
    constexpr unsigned movbe = 1U << 22, f16c = 1U << 29, lzcnt = 1U << 5;
    if (!__get_cpuid(1, &a, &b, &c, &d) || (c & movbe) == 0 || (c & f16c) == 0) return false;
    return __get_cpuid(0x80000001, &a, &b, &c, &d) && (c & lzcnt) != 0;
}
#endif

bool supported(std::string_view set) {
    if (set == "baseline") return true;
    if (std::string_view(HAMILCAR_ENGINES).find(set) == std::string_view::npos) return false;  // not built
#if defined(__x86_64__)
    __builtin_cpu_init();
    const bool v2 =
        __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("ssse3") && __builtin_cpu_supports("popcnt");
    const bool v3 = v2 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
                    __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma") && has_rest_of_v3();
    const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                    __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512vl");
    return set == "x86-64-v2" ? v2 : set == "x86-64-v3" ? v3 : set == "x86-64-v4" && v4;
#else
    return false;
#endif
}

// Beside the program that is running, where it was installed, where it was built.
std::vector<std::string> places(std::string_view set) {
    const std::string name = fmt::format("hamilcar_{}.so", set);
    std::vector<std::string> found;
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    if (!error) {
        const auto folder = program.parent_path() / HAMILCAR_ENGINE_FROM_PROGRAM;
        found.push_back((folder / name).lexically_normal().string());
    }
    found.push_back(std::string(HAMILCAR_ENGINE_INSTALLED) + "/" + name);
    found.push_back(std::string(HAMILCAR_ENGINE_BUILT) + "/" + name);
    return found;
}

const Engine& open_engine(std::string_view set) {
    if (set == "baseline") return engine_parts::engine();
    std::string tried;
    for (const std::string& path : places(set)) {
        // Local, so that no symbol of one instruction set is ever taken for another's.
        if (void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
            const auto function = reinterpret_cast<EngineFunction>(dlsym(library, HAMILCAR_ENGINE_FUNCTION));
            if (function) return *function();
            tried += fmt::format("\n  {}: of another build of hamilcar", path);
            dlclose(library);
        } else {
            tried += fmt::format("\n  {}", dlerror());
        }
    }
    throw std::runtime_error(fmt::format("the engine for {} cannot be opened; tried{}", set, tried));
}

}  // namespace

std::vector<std::string_view> supported_instruction_sets() {
    std::vector<std::string_view> found;
    std::copy_if(instruction_sets.begin(), instruction_sets.end(), std::back_inserter(found), supported);
    return found;
}

const Engine& engine(std::string_view instruction_set) {
    static std::mutex mutex;
    static std::map<std::string, const Engine*, std::less<>> opened;
    const std::vector<std::string_view> own = supported_instruction_sets();
    if (std::find(own.begin(), own.end(), instruction_set) == own.end()) {
        throw std::invalid_argument(fmt::format("instruction set \"{}\": expected one that this processor has: {}",
                                                instruction_set, fmt::join(own, ", ")));
    }
    const std::lock_guard lock(mutex);
    const auto found = opened.find(instruction_set);
    if (found != opened.end()) return *found->second;
    return *opened.emplace(instruction_set, &open_engine(instruction_set)).first->second;
}

const std::vector<const Engine*>& engines() {
    static const std::vector<const Engine*> opened = [] {
        std::vector<const Engine*> all;
        for (const std::string_view set : supported_instruction_sets()) {
            try {
                all.push_back(&engine(set));
            } catch (const std::runtime_error&) {
                // The others give the same results, if more slowly; the library's own is always there.
            }
        }
        return all;
    }();
    return opened;
}

}  // namespace hamilcar
