// Tire property files: every dialect's equations, units, sides and modes, what is listed and what is a mistake.
#include "hamilcar/io/tir_file.hpp"

#include "hamilcar/io/vehicle_file.hpp"
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

TEST(TireRemarks, TravelWithTheVehicle) {
    const TemporaryFolder folder;
    const std::string tire = folder.write("open.tir", changed(shipped(), "PKX2", "PKXX"));
    const std::string car = folder.write(
        "car.toml", changed(shipped_car_text(), repository_path("vehicles/tires/pacejka_205_60_r15.tir"), tire));
    const VehicleDescription vehicle = read_vehicle(car);
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
        const auto& magic = std::get<MagicFormulaDescription>(wheel.tire);
        EXPECT_EQ(magic.name, tire);
        EXPECT_THAT(magic.remarks, Contains(HasSubstr("taken as: PKX2 = 0")));
    });
}

TEST(TirFile, TheShippedOneLeavesNothingOpen) {
    const TirFile file = parsed(shipped());
    EXPECT_EQ(file.format, "MF-Tyre 6.0 (FITTYP 60)");
    EXPECT_TRUE(file.tire.remarks.empty()) << file.tire.remarks.front();
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
    EXPECT_THAT(with("").tire.remarks, Contains(HasSubstr("no 'FITTYP': taken as 6")));
    const std::string motorcycle = changed(shipped(), "FITTYP = 60", "FITTYP = 52");
    EXPECT_EQ(parsed(motorcycle).format, "MF-Tyre 5.2 (FITTYP 6)") << "many a car's file says so";
    EXPECT_THAT(parsed(motorcycle).tire.remarks, Contains(HasSubstr("FITTYP 52 is of motorcycle tires")));
    const std::string true_one = changed(motorcycle, "PCX1 =", "PCY2 = 0.6\nPCX1 =");
    EXPECT_THAT(mistake(true_one), HasSubstr(line_of(true_one, "FITTYP")));
    EXPECT_THAT(mistake(true_one), HasSubstr("motorcycle"));
    EXPECT_EQ(with("FITTYP = 70").format, "MF-Tyre 6.2 (FITTYP 62)");
    EXPECT_THAT(with("FITTYP = 70").tire.remarks, Contains(HasSubstr("newer than what is known: taken as 62")));
    EXPECT_THAT(mistake(changed(shipped(), "FITTYP = 60", "FITTYP = 3")), HasSubstr("expected one of 5, 6, 21"));
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
    EXPECT_THAT(unsaid.tire.remarks, Contains(HasSubstr("no TYRESIDE: assumed LEFT")));
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
    const auto notes = parsed(text).tire.remarks;
    EXPECT_THAT(notes, Contains(HasSubstr("1 coefficients are not in the file and taken as: PKX2 = 0")));
    EXPECT_THAT(
        notes, Contains(HasSubstr(line_of(text, "PXC9") + ": key 'PXC9' in [LONGITUDINAL_COEFFICIENTS] is not known")));
    EXPECT_THAT(notes,
                Contains(HasSubstr(line_of(text, "LMUV") + ": key 'LMUV' in [LONGITUDINAL_COEFFICIENTS] is not used")));
    EXPECT_THAT(notes, Contains(HasSubstr("the table of [SHAPE] is not used")));
    EXPECT_EQ(notes.size(), 4u) << "a key that is zero says nothing";
    EXPECT_THAT(parsed(changed(text, "PXC9", "PEX9")).tire.remarks, Contains(HasSubstr("did you mean")));
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
        EXPECT_THAT(file.tire.remarks, Contains(HasSubstr(said)));
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
                EXPECT_THAT(tir_from(file).tire.remarks, Contains(HasSubstr(key))) << key;
            } catch (const Error& error) {
                EXPECT_THAT(error.what(), HasSubstr(key));
            }
        }
    }
}

// What other programs read is read: each oddity, what is made of it, and what is told of it.
TEST(TirFile, ReadsOdditiesAndTellsWhatItTakes) {
    using Tire = MagicFormulaDescription;
    struct Oddity {
        std::string from, to, note;
        double (*read)(const Tire&);
        double value;
    };
    const auto stiffness = [](const Tire& t) { return t.casing.vertical_stiffness; };
    const auto radius = [](const Tire& t) { return t.casing.radius; };
    const std::string spring = "VERTICAL_STIFFNESS = 180e3", curve = "[DEFLECTION_LOAD_CURVE]\n{pen fz}\n";
    const std::vector<Oddity> oddities{
        {"KPUMAX = 1.5", "KPUMAX = 0.00000", "KPUMIN = -1.5 and KPUMAX = 0 leave no range: taken as -1.5 to 1.5",
         [](const Tire& t) { return t.slip[1]; }, 1.5},
        {"KPUMIN = -1.5", "KPUMIN = 0.2", "KPUMIN = 0.2 and KPUMAX = 1.5 leave no range: taken as -1.5 to 1.5",
         [](const Tire& t) { return t.slip[0]; }, -1.5},
        {"KPUMIN = -1.5\nKPUMAX = 1.5", "KPUMIN = 1.4\nKPUMAX = -1.2", "taken as -1.2 to 1.4",
         [](const Tire& t) { return t.slip[1]; }, 1.4},
        {"CAMMAX = 0.26", "CAMMAX = 0", "CAMMIN = -0.26 and CAMMAX = 0 leave no range",
         [](const Tire& t) { return t.camber[1]; }, 0.26},
        {"FZMIN = 100", "FZMIN = -50", "FZMIN = -50 and FZMAX = 10000 leave no range: taken as 0 to 10000",
         [](const Tire& t) { return t.load[0]; }, 0},
        {"FZMIN = 100", "FZMIN = 10000", "leave no range: taken as 0 to 400000",
         [](const Tire& t) { return t.load[0]; }, 0},
        {spring, curve + "0 0\n0.01 2000\n0.02 4400\n{second one}\n1 1\n",
         "no VERTICAL_STIFFNESS: taken from [DEFLECTION_LOAD_CURVE], 180000 N/m and 2e+06 N/m^2", stiffness, 180e3},
        {spring, curve + "0.02 4400\n", "taken from [DEFLECTION_LOAD_CURVE], 220000 N/m and 0 N/m^2", stiffness, 220e3},
        {spring, "VERTICAL_STIFFNESS = 0\nLOADED_RADIUS = 0.2748",
         "VERTICAL_STIFFNESS is not positive: taken from LOADED_RADIUS at FNOMIN, 200000 N/m", stiffness, 2e5},
        {"FREFF = ", "FREFF = 99\nX_FREFF = ", "is not between half the unloaded one and twice it: taken as 0.287393 m",
         [](const Tire& t) { return t.casing.rolling_radius; }, 0.2948 - 4000 / 180e3 / 3},
        {"UNLOADED_RADIUS = 0.2948", "UNLOADED_RADIUS = 0,2948", "UNLOADED_RADIUS = '0,2948' is read as 0.2948", radius,
         0.2948},
        {"UNLOADED_RADIUS = 0.2948", "UNLOADED_RADIUS = '0.2948'", "", radius, 0.2948},
        {"UNLOADED_RADIUS = 0.2948", "UNLOADED_RADIUS = 0.2948\nUNLOADED_RADIUS = 0.3",
         "duplicate key 'UNLOADED_RADIUS': the value in line", radius, 0.2948},
        {"LENGTH = 'meter'", "LENGTH =", "no LENGTH in [UNITS]: SI", radius, 0.2948},
        {"[UNITS]", "[SOMEBODY'S OWN]\nPURPOSE = 'none'\n[UNITS]",
         "key 'PURPOSE' in [SOMEBODY'S OWN] is not known and not used", radius, 0.2948},
    };
    for (const Oddity& odd : oddities) {
        SCOPED_TRACE(odd.to);
        const TirFile file = parsed(changed(shipped(), odd.from, odd.to));
        EXPECT_NEAR(odd.read(file.tire), odd.value, 1e-9 * std::abs(odd.value));
        if (odd.note.empty())
            EXPECT_TRUE(file.tire.remarks.empty());
        else
            EXPECT_EQ(std::ranges::count_if(file.tire.remarks,
                                            [&](const auto& note) { return note.find(odd.note) != note.npos; }),
                      1)
                << testing::PrintToString(file.tire.remarks);
    }
}

TEST(TirFile, AVehicleMaySayTheVerticalStiffnessOfAFileWithout) {
    const PropertyFile without = parse_property_file(changed(shipped(), "VERTICAL_STIFFNESS = 180e3", ""), "t.tir");
    EXPECT_EQ(tir_from(without, {.vertical_stiffness = 2e5}).tire.casing.vertical_stiffness, 2e5);
    EXPECT_THAT(mistake(changed(shipped(), "VERTICAL_STIFFNESS = 180e3", "")), HasSubstr("'VERTICAL_STIFFNESS'"));
    EXPECT_THAT(mistake(changed(shipped(), "VERTICAL_STIFFNESS = 180e3", "VERTICAL_STIFFNESS = -1")),
                HasSubstr("expected a positive number"));
}

TEST(TirFile, TellsWhereAMistakeIs) {
    struct Mistake {
        const char *from, *to, *said;
    };
    for (const Mistake& m : {Mistake{"FNOMIN = 4000", "FNOMIN = -4", "expected a positive number"},
                             Mistake{"PCX1 = 1.685", "PCX1 = 0", "expected a number other than zero"},
                             Mistake{"PKY1 = -14.95", "PKY1 = 'soft'", "expected a number"},
                             Mistake{"FITTYP = 60", "FITTYP = 'new'", "expected a number"}}) {
        const std::string text = changed(shipped(), m.from, m.to);
        EXPECT_THAT(mistake(text), HasSubstr(m.said));
        EXPECT_THAT(mistake(text), HasSubstr(line_of(text, m.to)));
    }
    EXPECT_THAT(mistake(changed(shipped(), "FNOMIN = 4000", "")), HasSubstr("missing required key 'FNOMIN'"));
}

}  // namespace
}  // namespace hamilcar::io
