// A tire that is accepted has forces everywhere in its ranges: what would make them no numbers is refused, or left out of
// the ranges.
#include "hamilcar/io/tir_limits.hpp"

#include <cmath>

#include "hamilcar/io/tir_file.hpp"
#include "io/files.hpp"

namespace hamilcar::io {
namespace {

TirFile read(const std::string& more) {
    return tir_from(
        parse_property_file("[A]\nFITTYP = 61\nFNOMIN = 4000\nUNLOADED_RADIUS = 0.3\nVERTICAL_STIFFNESS = 2e5\n"
                            "FZMAX = 12000\n" +
                                more,
                            "a.tir"));
}

void expect_refused_for(const std::string& more, const std::string& piece) {
    SCOPED_TRACE(more);
    expect_error([&] { read(more); }, ExitCode::bad_file, {"a.tir:", piece});
}

TEST(TirLimits, RefusesWhatForcesCannotBeComputedWith) {
    expect_refused_for("PHX1 = 1e200\n", "PHX1");
    expect_refused_for("VERTICAL_DAMPING = 1e20\n", "in SI");
    expect_refused_for("PDY1 = 1e-300\n", "PDY1");
    expect_refused_for("PKX1 = 1e5\nLKX = 1e5\n", "PKX1 with its scaling factors");
    expect_refused_for("LONGVL = 1e-320\n", "LONGVL");
    expect_refused_for("PKX3 = 800\n", "PKX3");
    expect_refused_for("NOMPRES = 1e5\nINFLPRES = 1.5e5\nPPY2 = -2\n", "PKY2");
    expect_refused_for("NOMPRES = 1e5\nINFLPRES = 0\n", "inflation pressure");
    expect_refused_for("LMUX = -1\n", "LMUX");
    expect_refused_for("LONGITUDINAL_STIFFNESS = 1e-9\nLATERAL_STIFFNESS = 1e5\n", "LONGITUDINAL_STIFFNESS");
}

// Without a line, since the key that is to blame stands under another name or not at all.
TEST(TirLimits, MistakesOfKeysThatAreNotThere) {
    expect_refused_for("LFZ0 = 0\n", "LFZO");
}

TEST(TirLimits, LeavesOutLoadsWithoutFriction) {
    const TirFile file = read("PDX1 = 1\nPDX2 = -1\nPDY1 = 1\nPDY2 = 1\n");
    EXPECT_NEAR(file.tire.load[1], 4000 * 1.9, 1e-6) << "where 0.1 of the friction is left, dfz = 0.9";
    EXPECT_NEAR(file.tire.load[0], 4000 * 0.1, 1e-6) << "dfz = -0.9";
    EXPECT_THAT(file.tire.remarks,
                testing::Contains(testing::HasSubstr("PDX2 reduces the force to zero at high loads")));
    expect_refused_for("PDX1 = 1\nPDX2 = -20\nPDY1 = 1\nPDY2 = 20\nFZMIN = 4190\n",
                       "expected some between FZMIN and FZMAX");
}

TEST(TirLimits, LeavesOutCamberWithoutFriction) {
    EXPECT_NEAR(read("PDY3 = 90\n").tire.camber[1], 0.1, 1e-12) << "1 - 90 camber^2 = 0.1";
    EXPECT_NEAR(read("PKY3 = 9\n").tire.camber[0], -0.1, 1e-12);
    EXPECT_NEAR(read("PKY2 = 1.6\nPKY5 = -1.44\n").tire.camber[1], 0.35, 1e-12)
        << "the model's own limit is before 1 rad";
}

TEST(TirLimits, LeavesAnOrdinaryTireAlone) {
    const TirFile file =
        read("PDX1 = 1.2\nPDX2 = -0.1\nPDY1 = -1\nPDY2 = 0.2\nPDX3 = -1\nPDY3 = 2\nPKY3 = 0.4\nPKY4 = 1.8\n");
    EXPECT_EQ(file.tire.load[1], 12000);
    EXPECT_EQ(file.tire.load[0], 0);
    EXPECT_EQ(file.tire.camber[1], 0.35);
}

}  // namespace
}  // namespace hamilcar::io
