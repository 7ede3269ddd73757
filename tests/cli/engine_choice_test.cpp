// Engines as the command line chooses them, and `hamilcar program`: what a step comes to, and the step as C.
#include <dlfcn.h>
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <nlohmann/json.hpp>

#include "cli/program.hpp"
#include "hamilcar/engine/engines.hpp"
#include "hamilcar/engine/rhs_trace.hpp"
#include "support/refuse_executable_memory.hpp"

namespace hamilcar {
namespace {

using testing::HasSubstr;

class EngineChoice : public Program {
protected:
    std::string scenario() const {
        return scenario_for(test::source_path("vehicles/bmw_323i.toml"),
                            "[initial]\nvelocity_m_per_s = 15.0\n[inputs.steering_wheel]\ntime_s = [0.1, 0.4]\n"
                            "angle_deg = [0.0, 40.0]\n[output]\nnetcdf = false\n");
    }
};

TEST_F(EngineChoice, GivesTheSameResultsByAll) {
    std::string first;
    for (const Engine* engine : engines()) {
        const std::string name(engine->name);
        const Outcome r = run("run " + scenario() + " --engine " + name + " -o " + name);
        ASSERT_EQ(r.code, 0) << r.err;
        EXPECT_EQ(r.err.find("portable engine"), std::string::npos) << r.err;
        const std::string rows = contents(folder_ / name / "results.csv");
        EXPECT_GT(rows.size(), 1000u);
        if (first.empty()) first = rows;
        EXPECT_EQ(rows, first) << name;
    }
}

TEST_F(EngineChoice, RefusesAnUnknownOne) {
    const Outcome r = run("--engine mmx run " + scenario());
    EXPECT_EQ(r.code, 2);
    EXPECT_THAT(r.err, HasSubstr("--engine: engine \"mmx\": expected one that this machine supports: "));
    EXPECT_THAT(r.err, HasSubstr("portable"));
}

#if defined(__x86_64__) && defined(__linux__)
TEST_F(EngineChoice, RunsWithoutGeneratedCodeWhereTheSystemForbidsIt) {
    ASSERT_EQ(run("run " + scenario() + " -o free").code, 0);
    const std::string path = scenario();
    const pid_t child = fork();
    if (child == 0) {
        if (chdir(folder_.c_str()) != 0 || !test::refuse_executable_memory(true)) _exit(100);
        if (!freopen("err.txt", "w", stderr) || !freopen("out.txt", "w", stdout)) _exit(101);
        execl(test::program_path().c_str(), "hamilcar", "run", path.c_str(), "-o", "hardened", nullptr);
        _exit(102);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    if (WEXITSTATUS(status) == 100) GTEST_SKIP() << "this system has no seccomp filters";
    const std::string err = contents(folder_ / "err.txt");
    EXPECT_EQ(WEXITSTATUS(status), 0) << err;
    EXPECT_THAT(err, HasSubstr("memory that may be executed"));
    EXPECT_THAT(err, HasSubstr("the portable engine runs instead"));
    EXPECT_EQ(err.find("portable engine"), err.rfind("portable engine")) << "told once";
    EXPECT_EQ(contents(folder_ / "hardened/results.csv"), contents(folder_ / "free/results.csv"));
}
#endif

TEST_F(EngineChoice, CountsAProgramByBlock) {
    const Outcome r = run("program " + test::source_path("vehicles/formula.toml") + " --json");
    ASSERT_EQ(r.code, 0) << r.err;
    const nlohmann::json facts = nlohmann::json::parse(r.out);
    for (const char* block : {"velocity", "momenta"}) EXPECT_GT(facts["operations"][block]["multiplications"], 1000);
    EXPECT_GT(facts["operations"]["integration"]["additions"], 10);
    ASSERT_EQ(facts["engines"].size(), 2 * engines().size());
    for (const auto& engine : facts["engines"]) EXPECT_GT(engine["code_bytes"], 10000) << engine;
    EXPECT_THAT(run("program " + test::source_path("vehicles/formula.toml")).out, HasSubstr("multiplications"));
}

// The C text, compiled and run, gives the rates of the plain program to the last bit.
class CFunction : public EngineChoice, public testing::WithParamInterface<const char*> {};
INSTANTIATE_TEST_SUITE_P(Vehicles, CFunction, testing::Values("bmw_323i", "truck_semitrailer"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(CFunction, GivesTheRatesOfThePlainProgram) {
    const std::string vehicle = test::source_path("vehicles/" + std::string(GetParam()) + ".toml");
    const Outcome r = run("program " + vehicle + " --c turn.c");
    ASSERT_EQ(r.code, 0) << r.err;
    const std::string place = folder_.string();
    ASSERT_EQ(
        std::system(("cc -O1 -ffp-contract=off -fPIC -shared -o " + place + "/turn.so " + place + "/turn.c").c_str()),
        0);
    void* library = dlopen((place + "/turn.so").c_str(), RTLD_NOW);
    ASSERT_NE(library, nullptr) << dlerror();
    using Function = void (*)(double* const*, void (*const*)(const void*, int, int, const void*, void*), const void*);
    const auto turn = reinterpret_cast<Function>(dlsym(library, "hamilcar_turn"));
    ASSERT_NE(turn, nullptr);

    ScenarioDescription scenario = test::scenario(1, 8);
    scenario.throttle = test::table({0}, {0.2}), scenario.gear = test::table({0}, {1});
    Simulation simulation(io::read_vehicle(vehicle), scenario);
    for (int i = 0; i < 100; ++i) ASSERT_FALSE(simulation.advance());
    Model<double> model = simulation.model();
    model.energy_balance = false;
    Input<double> input;
    input.rack = {0.004, 0.02, 0.1}, input.brake = 0.1, input.throttle = 0.3, input.gear = 1;
    State<double> state = simulation.state(), expected;
    evaluate_rhs(model, input, state, expected);

    std::array<double, RhsInput::size> inputs{0.004, 0.02, 0.1, 0, 0.1, 0.3, 0, 1};
    std::vector<double> rate(state.values.size()), report(state.values.size());
    double* arrays[] = {state.values.data(), inputs.data(), nullptr, rate.data(), report.data()};
    turn(arrays, nullptr, nullptr);
    for (std::size_t k = 0; k < static_cast<std::size_t>(model.vehicle.state_size); ++k) {
        EXPECT_EQ(rate[k], expected.values[k]) << "number " << k;
    }
    EXPECT_GT(report[RhsReport::mobility], 0.1);
    dlclose(library);
}

}  // namespace
}  // namespace hamilcar
