// The command line itself: help, unknown words, quiet and verbose, what shells and man(1) are given.
#include <gmock/gmock.h>

#include <filesystem>

#include "cli/program.hpp"

namespace hamilcar {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string car = test::source_path("vehicles/bmw_323i.toml");

TEST_F(Program, HelpsWithACommandEitherWay) {
    const Outcome word = run("help kinematics"), flag = run("kinematics --help");
    EXPECT_EQ(word.code, 0) << word.err;
    EXPECT_EQ(word.out, flag.out);
    EXPECT_EQ(run("help").out, run("--help").out);
    EXPECT_EQ(run("-V").out, run("--version").out);
}

TEST_F(Program, NamesTheOptionThatWasMeant) {
    const Outcome near = run("run --manuever cleat"), far = run("check --nonsense " + car);
    EXPECT_EQ(near.code, 2);
    EXPECT_THAT(near.err, HasSubstr("unknown option '--manuever': did you mean '--maneuver'?"));
    EXPECT_THAT(near.err, HasSubstr("Try 'hamilcar run --help'."));
    EXPECT_EQ(far.code, 2);
    EXPECT_THAT(far.err, HasSubstr("unknown option '--nonsense': expected "));
    EXPECT_THAT(far.err, HasSubstr("'--strict'"));
    EXPECT_THAT(far.err, Not(HasSubstr("'--maneuver'"))) << "that of another command";
}

TEST_F(Program, PrintsNothingButErrorsWhereItIsToBeQuiet) {
    const Outcome good = run("check --quiet " + car), bad = run("-q check nothing.toml");
    EXPECT_EQ(good.code, 0);
    EXPECT_EQ(good.out + good.err, "");
    EXPECT_EQ(bad.code, 5);
    EXPECT_EQ(bad.out, "");
    EXPECT_THAT(bad.err, HasSubstr("nothing.toml"));
}

TEST_F(Program, TellsWhatItReadsAndTakesWhereItIsToBeVerbose) {
    const Outcome plain = run("check " + car), told = run("check -v " + car);
    EXPECT_EQ(told.code, 0);
    EXPECT_EQ(told.out, plain.out) << "results stay what they are";
    EXPECT_EQ(plain.err, "");
    EXPECT_THAT(told.err, HasSubstr("read " + car + ", "));
    EXPECT_THAT(told.err, HasSubstr("of processor time, "));
    const Outcome driven = run("run --verbose --maneuver step_steer --no-recording --vehicle " + car + " -o told");
    EXPECT_THAT(driven.err, HasSubstr("compiled a right-hand side of "));
    EXPECT_EQ(run("check -v -q " + car).code, 2);
}

TEST_F(Program, TellsWhatItWroteOnStandardOutput) {
    const Outcome text = run("kinematics " + car + " -o k"), json = run("kinematics --json " + car + " -o k");
    EXPECT_THAT(text.out, HasSubstr("wrote kinematics.html"));
    EXPECT_EQ(text.err, "");
    EXPECT_THAT(json.out, Not(HasSubstr("wrote"))) << "one JSON object";
}

// Ten runs on one page make it no larger than one.
TEST_F(Program, SharesTheRowsOfAPageAmongItsRuns) {
    ASSERT_EQ(run("run " + test::source_path("scenarios/slalom.toml") + " -o a").code, 0);
    const Outcome one = run("view a/results.nc -o one.html --rows 1601"),
                  two = run("view a/results.nc a/results.nc -o two.html --rows 1601");
    EXPECT_EQ(one.err, "");
    EXPECT_THAT(two.err, HasSubstr("of 1601 rows are shown; --rows 3202 shows all"));
    EXPECT_LT(static_cast<double>(std::filesystem::file_size(folder_ / "two.html")),
              1.1 * static_cast<double>(std::filesystem::file_size(folder_ / "one.html")));
}

// What bash offers for a line, its last word unfinished.
TEST_F(Program, CompletesInBash) {
    ASSERT_EQ(run("completion bash -o hamilcar.bash").code, 0);
    const auto offers = [&](const std::string& words) {
        std::string line;
        std::istringstream in(words);
        std::size_t count = 0;
        for (std::string word; in >> word; ++count) line += " '" + (word == "_" ? "" : word) + "'";
        const std::string script = "cd '" + folder_.string() + "' && source ./hamilcar.bash && COMP_WORDS=(" + line +
                                   ") && COMP_CWORD=" + std::to_string(count - 1) +
                                   " && _hamilcar && printf '%s\\n' \"${COMPREPLY[@]}\"";
        std::ofstream(folder_ / "script") << script;
        EXPECT_EQ(
            std::system(
                ("bash '" + (folder_ / "script").string() + "' > '" + (folder_ / "offers").string() + "'").c_str()),
            0);
        return contents(folder_ / "offers");
    };
    EXPECT_EQ(offers("hamilcar kin"), "kinematics\n");
    EXPECT_EQ(offers("hamilcar run --maneuver double"), "double_lane_change\n");
    EXPECT_EQ(offers("hamilcar run --mane"), "--maneuver\n");
    EXPECT_EQ(offers("hamilcar schema ve"), "vehicle\n");
    EXPECT_EQ(offers("hamilcar completion _"), "bash\nzsh\nfish\n");
    EXPECT_THAT(offers("hamilcar --engine p"), HasSubstr("portable\n"));
    EXPECT_THAT(offers("hamilcar check --q"), HasSubstr("--quiet\n"));
    EXPECT_EQ(offers("hamilcar check hamilcar.b"), "hamilcar.bash\n") << "a file";
    EXPECT_THAT(offers("hamilcar help mo"), HasSubstr("modes\n"));
}

// zsh and fish, where they are, take their scripts; every command and option is in all of them and on the manual page.
TEST_F(Program, KnowsEveryOptionInEveryShellAndOnTheManualPage) {
    const std::string bash = run("completion bash").out, zsh = run("completion zsh").out,
                      fish = run("completion fish").out, manual = run("manual").out;
    for (const char* word : {"run", "compare", "kinematics", "completion"}) {
        for (const std::string& text : {bash, zsh, fish, manual}) EXPECT_THAT(text, HasSubstr(word));
    }
    EXPECT_THAT(bash, HasSubstr("--checkpoint-interval"));
    EXPECT_THAT(zsh, HasSubstr("--checkpoint-interval"));
    EXPECT_THAT(fish, HasSubstr("-l checkpoint-interval"));
    EXPECT_THAT(manual, HasSubstr("\\-\\-checkpoint\\-interval"));
    for (const auto& [shell, text] : {std::pair{"zsh", zsh}, {"fish", fish}}) {
        if (std::system(("command -v " + std::string(shell) + " >/dev/null").c_str()) != 0) continue;
        std::ofstream(folder_ / "script") << text;
        EXPECT_EQ(std::system((std::string(shell) + " -n '" + (folder_ / "script").string() + "'").c_str()), 0)
            << shell;
    }
    if (std::system("command -v man >/dev/null && command -v nroff >/dev/null") == 0) {
        std::ofstream(folder_ / "page") << manual;
        EXPECT_EQ(std::system(("nroff -man -ww '" + (folder_ / "page").string() + "' >/dev/null 2>'" +
                               (folder_ / "said").string() + "'")
                                  .c_str()),
                  0);
        EXPECT_EQ(contents(folder_ / "said"), "");
    }
}

}  // namespace
}  // namespace hamilcar
