// `hamilcar new`: from nothing to a vehicle that drives; what stands in a file's place stays.
#include <gmock/gmock.h>

#include "cli/program.hpp"

namespace hamilcar {
namespace {

using testing::HasSubstr;

class New : public Program {};

TEST_F(New, WritesAVehicleThatDrives) {
    const Outcome made =
        run("new my_car.toml --front double_wishbone --rear five_link --like sedan --set mass_kg=1200");
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr("wrote my_car.toml\nnext: hamilcar check my_car.toml\n"));
    const Outcome check = run("check my_car.toml --strict");
    EXPECT_EQ(check.code, 0) << check.out << check.err;
    EXPECT_THAT(check.out, HasSubstr("my_car, 1200.0 kg, 5 bodies"));
    for (const char* maneuver : {"step_steer", "straight_braking", "acceleration"}) {
        const Outcome driven =
            run(std::string("run --vehicle my_car.toml --no-recording -o out --maneuver ") + maneuver);
        EXPECT_EQ(driven.code, 0) << driven.out << driven.err;
    }
}

TEST_F(New, LeavesWhatIsThere) {
    ASSERT_EQ(run("new car.toml").code, 0);
    std::ofstream(folder_ / "car.toml", std::ios::app) << "# mine\n";
    const std::string before = contents(folder_ / "car.toml");
    const Outcome again = run("new car.toml --like pickup");
    EXPECT_EQ(again.code, 2);
    EXPECT_THAT(again.err, HasSubstr("car.toml: is there already, and stays: expected a new name"));
    EXPECT_EQ(contents(folder_ / "car.toml"), before);
}

TEST_F(New, SaysWhatIsWrong) {
    struct Wrong {
        std::string words, message;
        int code = 2;
    };
    for (const Wrong& w : std::vector<Wrong>{
             {"new", "expected a file to write, or --list"},
             {"new car.txt", "car.txt: expected a name that ends in .toml"},
             {"new car.toml --like sedna", "sedna"},
             {"new car.toml --front five_lnik", "five_lnik"},
             {"new car.toml --front trailing_arm",
              "--front 'trailing_arm': expected a suspension that can be steered, 'macpherson', "},
             {"new car.toml --set mass=1200", "--set 'mass=1200': expected one of 'mass_kg', "},
             {"new car.toml --set mass=1200", "did you mean 'mass_kg'?"},
             {"new car.toml --set mass_kg=heavy", "--set 'mass_kg=heavy': expected a number from 200 to 6000"},
             {"new car.toml --set mass_kg", "--set 'mass_kg': expected a number from 200 to 6000"},
             {"new car.toml --set wheelbase_m=2450", "expected a number from 1.4 to 6"},
             {"new none/car.toml", "none/car.toml", 5}}) {
        const Outcome r = run(w.words);
        EXPECT_EQ(r.code, w.code) << w.words;
        EXPECT_THAT(r.err, HasSubstr(w.message)) << w.words;
        EXPECT_FALSE(std::filesystem::exists(folder_ / "car.toml")) << w.words;
    }
}

TEST_F(New, ListsWhatThereIs) {
    const Outcome list = run("new --list");
    EXPECT_EQ(list.code, 0);
    for (const char* word :
         {"roadster", "double_wishbone", "semi_trailing_arm  Semi-trailing arm (at the rear", "wheelbase_m"}) {
        EXPECT_THAT(list.out, HasSubstr(word));
    }
}

}  // namespace
}  // namespace hamilcar
