// Tire property files: every dialect's equations, units, sides and modes, what is listed and what is a mistake.
#include "hamilcar/io/tir_file.hpp"

#include "io/files.hpp"

namespace hamilcar::io {
namespace {

using testing::Contains;
using testing::HasSubstr;

const std::string& shipped() {
    static const std::string text = read_file(repository_path("vehicles/tires/pacejka_205_60_r15.tir"));
    return text;
}

TirFile parsed(const std::string& text) {
    return tir_from(parse_property_file(text, "t.tir"));
}

std::string mistake(const std::string& text) {
    try {
        parsed(text);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_file);
        return error.what();
    }
    return "no mistake";
}

std::string line_of(const std::string& text, const std::string& what) {
    const std::string position = position_in(text, what);
    return "t.tir:" + position.substr(0, position.find(':'));
}

TEST(TirFile, TheShippedOneLeavesNothingOpen) {
    const TirFile file = parsed(shipped());
    EXPECT_EQ(file.format, "MF-Tyre 6.0 (FITTYP 60)");
    EXPECT_TRUE(file.notes.empty()) << file.notes.front();
    EXPECT_EQ(file.tire.nominal_load, 4000);
    EXPECT_NEAR(file.tire.casing.rolling_radius, 0.288, 1e-12);  // as its comment says
    EXPECT_EQ(file.tire.coefficients[PKY1], -14.95);
    EXPECT_EQ(file.tire.coefficients[PHY1], 0) << "symmetric: without ply steer";
}

TEST(TirFile, SaysWhichEquations) {
    const auto with = [](const char* fit) { return parsed(changed(shipped(), "FITTYP = 60", fit)); };
    const TirFile old = with("FITTYP = 6"), last = with("FITTYP = 62");
    EXPECT_EQ(old.format, "MF-Tyre 5.2 (FITTYP 6)");
    EXPECT_TRUE(old.tire.angle_slip && !old.tire.camber_by_stiffness);
    EXPECT_TRUE(!last.tire.angle_slip && last.tire.camber_by_stiffness && last.tire.upright_aligning_force);
    EXPECT_EQ(with("PROPERTY_FILE_FORMAT = 'PAC2002'").format, "PAC2002 (FITTYP 6)");
    EXPECT_THAT(with("").notes, Contains(HasSubstr("no 'FITTYP': taken as 6")));
    const std::string motorcycle = changed(shipped(), "FITTYP = 60", "FITTYP = 52");
    EXPECT_THAT(mistake(motorcycle), HasSubstr(line_of(motorcycle, "FITTYP")));
    EXPECT_THAT(mistake(motorcycle), HasSubstr("motorcycle"));
}

// The same tire in millimeters, kilonewtons and degrees.
TEST(TirFile, ConvertsTheFilesUnits) {
    std::string text = shipped();
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"LENGTH = 'meter'", "LENGTH = 'mm'"},
             {"FORCE = 'newton'", "FORCE = 'KN'"},
             {"ANGLE = 'radians'", "ANGLE = 'degrees'"},
             {"UNLOADED_RADIUS = 0.2948", "UNLOADED_RADIUS = 294.8"},
             {"FNOMIN = 4000", "FNOMIN = 4"},
             {"VERTICAL_STIFFNESS = 180e3", "VERTICAL_STIFFNESS = 0.18"},
             {"VERTICAL_DAMPING = 300", "VERTICAL_DAMPING = 3D-4"},
             {"LONGITUDINAL_STIFFNESS = 310e3", "LONGITUDINAL_STIFFNESS = 0.31"},
             {"LATERAL_STIFFNESS = 125e3", "LATERAL_STIFFNESS = 0.125"},
             {"LONGVL = 16.7", "LONGVL = 16700"},
             {"FZMIN = 100", "FZMIN = 0.1"},
             {"FZMAX = 10000", "FZMAX = 10"},
             {"CAMMAX = 0.26", "CAMMAX = 14.896902673401405"}}) {
        text = changed(text, from, to);
    }
    const MagicFormulaDescription here = parsed(shipped()).tire, there = parsed(text).tire;
    const auto same = [](double a, double b) { EXPECT_NEAR(a, b, 1e-12 * std::abs(a)); };
    same(here.casing.radius, there.casing.radius), same(here.nominal_load, there.nominal_load);
    same(here.casing.vertical_stiffness, there.casing.vertical_stiffness);
    same(here.casing.vertical_damping, there.casing.vertical_damping);
    same(here.casing.rolling_radius, there.casing.rolling_radius);
    same(here.carcass_x, there.carcass_x), same(here.carcass_y, there.carcass_y);
    same(here.nominal_speed, there.nominal_speed);
    same(here.load[0], there.load[0]), same(here.load[1], there.load[1]), same(here.camber[1], there.camber[1]);
    EXPECT_EQ(here.coefficients[PKX1], there.coefficients[PKX1]) << "coefficients have no unit";
}

TEST(TirFile, HonorsTheSide) {
    const auto on = [](const char* side) { return parsed(changed(shipped(), "TYRESIDE = 'SYMMETRIC'", side)); };
    const TirFile left = on("TYRESIDE = 'LEFT'"), right = on("TYRESIDE = 'Right'"), unsaid = on("");
    EXPECT_EQ(left.tire.coefficients[PHY1], 0.003);
    EXPECT_EQ(right.tire.coefficients[PHY1], -0.003) << "kept as on the left side";
    EXPECT_EQ(right.tire.coefficients[PKY6], left.tire.coefficients[PKY6]);
    EXPECT_EQ(unsaid.tire.coefficients[PHY1], 0.003);
    EXPECT_THAT(unsaid.notes, Contains(HasSubstr("no TYRESIDE: taken as LEFT")));
}

TEST(TirFile, HonorsTheMode) {
    const auto in = [](const std::string& mode) {
        return parsed(changed(shipped(), "USE_MODE = 14", "USE_MODE = " + mode)).tire;
    };
    EXPECT_TRUE(in("1").has_longitudinal && !in("1").has_lateral);
    EXPECT_TRUE(!in("12").has_longitudinal && in("12").has_lateral);
    EXPECT_TRUE(in("13").has_longitudinal && in("13").has_lateral);
    EXPECT_EQ(in("13").coefficients[RBX1], 0) << "both without each other";
    EXPECT_EQ(in("24").coefficients[RBX1], 12.35);
    EXPECT_TRUE(in("24").has_combined && !in("3").has_combined) << "slip along does not reach the moment";
    EXPECT_EQ(in("2").coefficients[QSY1], 0) << "no rolling resistance";
    EXPECT_FALSE(in("0").has_longitudinal || in("0").has_lateral);
    EXPECT_THAT(mistake(changed(shipped(), "USE_MODE = 14", "USE_MODE = 9")), HasSubstr("expected 0 to 5"));
}

TEST(TirFile, ListsWhatIsUnknownUnusedOrMissing) {
    std::string text = changed(shipped(), "PKX2 = -0.163\n", "");
    text = changed(text, "PCX1 = 1.685", "PCX1 = 1.685\nPXC9 = 4\nLMUV = 0.1\nBOTTOM_STIFF = 0");
    text += "[SHAPE]\n{radial width}\n1.0 0.0\n1.0 0.4\n";
    const auto notes = parsed(text).notes;
    EXPECT_THAT(notes, Contains(HasSubstr("1 coefficients are not in the file and taken as: PKX2 = 0")));
    EXPECT_THAT(
        notes, Contains(HasSubstr(line_of(text, "PXC9") + ": key 'PXC9' in [LONGITUDINAL_COEFFICIENTS] is not known")));
    EXPECT_THAT(notes,
                Contains(HasSubstr(line_of(text, "LMUV") + ": key 'LMUV' in [LONGITUDINAL_COEFFICIENTS] is not used")));
    EXPECT_THAT(notes, Contains(HasSubstr("the table of [SHAPE] is not used")));
    EXPECT_EQ(notes.size(), 4u) << "a key that is zero says nothing";
    EXPECT_THAT(parsed(changed(text, "PXC9", "PEX9")).notes, Contains(HasSubstr("did you mean")));
}

TEST(TirFile, FillsAReducedFile) {
    const TirFile file = parsed(
        "[MODEL]\nFITTYP = 61\nTYRESIDE = 'LEFT'\n[DIMENSION]\nUNLOADED_RADIUS = 0.31\n[VERTICAL]\nFNOMIN = 4000\n"
        "VERTICAL_STIFFNESS = 2e5\nVERTICAL_DAMPING =\n[LATERAL_COEFFICIENTS]\nPKY1 = -20\nPDY1 = 0.9\n");
    EXPECT_EQ(file.tire.coefficients[PKY4], 2);
    EXPECT_EQ(file.tire.coefficients[LMUX], 1);
    EXPECT_NEAR(file.tire.carcass_y * 0.31, 20 * 4000 * std::sin(2 * std::atan(1 / 1.5)), 1e-6)
        << "one unloaded radius of relaxation at the nominal load";
    for (const char* said : {"no LENGTH in [UNITS]", "coefficients are not in the file", "relaxation lengths estimated",
                             "rolling radius taken", "no 'VERTICAL_DAMPING'"}) {
        EXPECT_THAT(file.notes, Contains(HasSubstr(said)));
    }
}

// A vehicle's file may use the set on another size and pressure: the casing follows, the coefficients stay.
TEST(TirFile, TakesWhatAVehicleSaysOtherwise) {
    const auto with = [](const TirOverrides& overrides) {
        return tir_from(parse_property_file(changed(shipped(), "BREFF = 0\n", "BREFF = 0\nPFZ1 = 0.8\n"), "t.tir"),
                        overrides)
            .tire;
    };
    const auto plain = with({}), pumped = with({.pressure = 264e3});
    EXPECT_NEAR(pumped.casing.vertical_stiffness, plain.casing.vertical_stiffness * (1 + 0.8 * 0.2), 1e-6);
    EXPECT_EQ(pumped.pressure, 264e3);
    const auto small = with({.radius = 0.28, .vertical_stiffness = 2e5});
    EXPECT_EQ(small.casing.radius, 0.28);
    EXPECT_NEAR(small.casing.rolling_radius, 0.28 - 4000 / 2e5 * 0.306, 1e-12) << "by the file's FREFF";
    EXPECT_EQ(small.nominal_radius, 0.2948) << "the formulas' own";
    EXPECT_THROW(with({.pressure = 2.2}), Error) << "bar instead of pascal";
}

// Nothing is filled in silently: every key that is left out is told about.
TEST(TirFile, EveryMissingKeyIsTold) {
    const PropertyFile whole = parse_property_file(shipped(), "t.tir");
    for (std::size_t s = 0; s < whole.sections.size(); ++s) {
        for (std::size_t e = 0; e < whole.sections[s].entries.size(); ++e) {
            PropertyFile file = whole;
            const std::string key = file.sections[s].entries[e].key;
            file.sections[s].entries.erase(file.sections[s].entries.begin() + static_cast<std::ptrdiff_t>(e));
            try {
                EXPECT_THAT(tir_from(file).notes, Contains(HasSubstr(key))) << key;
            } catch (const Error& error) {
                EXPECT_THAT(error.what(), HasSubstr(key));
            }
        }
    }
}

TEST(TirFile, TellsWhereAMistakeIs) {
    struct Mistake {
        const char *from, *to, *said;
    };
    for (const Mistake& m : {Mistake{"FNOMIN = 4000", "FNOMIN = -4", "expected a positive number"},
                             Mistake{"PCX1 = 1.685", "PCX1 = 0", "expected a number other than zero"},
                             Mistake{"PKY1 = -14.95", "PKY1 = 'soft'", "expected a number"},
                             Mistake{"KPUMAX = 1.5", "KPUMAX = -2", "expected KPUMIN below KPUMAX"},
                             Mistake{"CAMMAX = 0.26", "CAMMAX = -0.1", "above zero"},
                             Mistake{"FITTYP = 60", "FITTYP = 'new'", "expected a number"}}) {
        const std::string text = changed(shipped(), m.from, m.to);
        EXPECT_THAT(mistake(text), HasSubstr(m.said));
        EXPECT_THAT(mistake(text), HasSubstr(line_of(text, m.to)));
    }
    EXPECT_THAT(mistake(changed(shipped(), "FNOMIN = 4000", "")), HasSubstr("no 'FNOMIN'"));
}

}  // namespace
}  // namespace hamilcar::io
