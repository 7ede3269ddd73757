// Memory that holds programs: never writable and executable at once, released, and reported when refused.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>
#include <fstream>
#include <thread>

#include "program/running.hpp"

#include "support/refuse_executable_memory.hpp"

#ifdef __linux__

namespace hamilcar::program {
namespace {

using namespace test;

std::vector<const Backend*> available() {
    std::vector<const Backend*> all;
    for (const Backend& backend : backends()) {
        if (backend.is_available()) all.push_back(&backend);
    }
    return all;
}

Graph small_graph(unsigned seed) {
    return random_graph(seed, {.size = 60, .max_width = 1});
}

// In a child process. Exits with the number of backends that failed, 100 if nothing can be tested.
[[noreturn]] void compile_where_refused(bool warm) {
    const Graph graph = small_graph(1);
    if (warm) {  // memory from before may still be there
        for (const Backend* backend : available()) backend->compile(graph, true);
    }
    if (!hamilcar::test::refuse_executable_memory(false)) std::exit(100);
    int wrong = 0;
    std::vector<std::unique_ptr<Executable>> kept;
    for (const Backend* backend : available()) {
        const bool may_fail = backend->name != "portable";
        try {
            for (unsigned i = 0; i < 200; ++i) {
                kept.push_back(backend->compile(graph, true));
                wrong += !computes(*kept.back(), graph, i);
            }
            wrong += may_fail;  // 200 programs do not fit what was there before
        } catch (const std::runtime_error& error) {
            std::fprintf(stderr, "%s: %s\n", std::string(backend->name).c_str(), error.what());
            wrong += !may_fail || std::string(error.what()).find("memory") == std::string::npos;
        }
    }
    std::exit(wrong);
}

void expect_refusal_in_words(bool warm) {
    GTEST_FLAG_SET(death_test_style, "fast");
    static constexpr auto can_test = [](int status) { return WIFEXITED(status) && WEXITSTATUS(status) != 100; };
    bool tested = true;
    EXPECT_EXIT({ compile_where_refused(warm); },
                [&tested](int status) {
                    tested = can_test(status);
                    return !tested || (WIFEXITED(status) && WEXITSTATUS(status) == 0);
                },
                "");
    if (!tested) GTEST_SKIP() << "this system has no seccomp filters";
}

TEST(BackendDeathTest, SaysWhereTheSystemRefusesExecutableMemory) {
    expect_refusal_in_words(false);
}

TEST(BackendDeathTest, SaysWhereTheSystemRefusesMoreExecutableMemory) {
    expect_refusal_in_words(true);
}

int writable_and_executable_pages() {
    std::ifstream maps("/proc/self/maps");
    int count = 0;
    for (std::string range, rights, rest; maps >> range >> rights && std::getline(maps, rest);) {
        count += rights.find('w') != std::string::npos && rights.find('x') != std::string::npos;
    }
    return count;
}

// Looked at from another thread while programs are made.
TEST(Backend, HasNoPageThatIsWritableAndExecutable) {
    std::atomic<bool> done = false;
    std::thread compiling([&] {
        for (unsigned seed = 0; seed < 300; ++seed) {
            for (const Backend* backend : available()) {
                const Graph graph = small_graph(seed);
                backend->compile(graph, true);
            }
        }
        done = true;
    });
    std::vector<std::unique_ptr<Executable>> kept;
    int looks = 0, found = 0;
    for (; !done || looks < 20; ++looks) {
        for (const Backend* backend : available()) kept.push_back(backend->compile(small_graph(7), true));
        found += writable_and_executable_pages();
    }
    compiling.join();
    EXPECT_EQ(found, 0) << "in " << looks << " looks";
}

struct Pages {
    long total = 0, resident = 0;
};
Pages pages() {
    Pages now;
    std::ifstream("/proc/self/statm") >> now.total >> now.resident;
    return now;
}

TEST(Backend, GivesMemoryBack) {
#ifdef HAMILCAR_SANITIZED
    GTEST_SKIP() << "the address sanitizer keeps what is freed";
#endif
    std::vector<Graph> graphs;
    for (unsigned seed = 0; seed < 10; ++seed) graphs.push_back(small_graph(seed));
    for (const Backend* backend : available()) {
        const auto work = [&](int times) {
            for (int i = 0; i < times; ++i) {
                const Graph& graph = graphs[static_cast<std::size_t>(i % 10)];
                const auto executable = backend->compile(graph, i % 3 == 0);
                if (i % 50 == 0) {
                    EXPECT_TRUE(computes(*executable, graph, static_cast<unsigned>(i)));
                }
            }
        };
        work(500);
        const Pages before = pages();
        work(10000);
        const Pages after = pages();
        EXPECT_LT(after.total - before.total, 64) << backend->name << ", pages";
        EXPECT_LT(after.resident - before.resident, 64) << backend->name << ", pages";
    }
}

}  // namespace
}  // namespace hamilcar::program
#endif
