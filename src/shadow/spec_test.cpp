#include "shadewright/shadow/spec.h"

#include <gtest/gtest.h>

#include "shadewright/error.h"
#include "shadewright/shadow/technique.h"

namespace shadewright::shadow {
namespace {

std::string refusal(const std::string& text) {
  try {
    parse_spec(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SpecTest, FillsInWhatIsLeftOut) {
  const Spec spec = parse_spec("uniform");
  EXPECT_EQ(spec.canonical(), "uniform/depth/hard@2048");
  EXPECT_EQ(spec.choice("fit"), "view");
  EXPECT_EQ(spec.number("bias"), 1);
}

TEST(SpecTest, WritesAliasesOut) {
  EXPECT_EQ(parse_spec("sm@512").canonical(), "uniform/depth/hard@512");
  EXPECT_EQ(parse_spec("pcf,width=0.2,radius=3").canonical(), "uniform/depth/pcf@2048,radius=3,width=0.2");
  EXPECT_EQ(parse_spec("sm,bias=1,fit=view").canonical(), "uniform/depth/hard@2048");
  EXPECT_EQ(parse_spec("csm@1024,stable=1,splits=pssm").canonical(), "cascaded/depth/pcf@1024,stable=1");
  EXPECT_EQ(parse_spec("vsm,bleeding=0.2,blur=3").canonical(), "uniform/moments/pcf@2048,bleeding=0.2,blur=3");
  EXPECT_EQ(parse_spec("ray").canonical(), "ray");
  EXPECT_EQ(parse_spec("cpvs").canonical(), "precomputed@16384");
  EXPECT_EQ(parse_spec("cpvs,file=sun.cpvs").canonical(), "precomputed,file=sun.cpvs");
  EXPECT_EQ(parse_spec("cpvs@65536,taps=9,dynamic=(pcf@1024,radius=2)").canonical(),
            "precomputed@65536,dynamic=(uniform/depth/pcf@1024,radius=2),taps=9");
}

TEST(SpecTest, ListsTheKeysThatATechniqueTakes) {
  std::vector<std::string> names;
  for (const SpecKey& key : parse_spec("csm").keys()) names.push_back(key.name);
  EXPECT_EQ(names, (std::vector<std::string>{"bias", "radius", "cascades", "lambda", "splits", "stable", "width"}));
  for (const SpecKey& key : parse_spec("psm").keys())
    if (key.name == "fit") {
      EXPECT_EQ(key.owner, "perspective");
    }
  EXPECT_TRUE(parse_spec("ray").keys().empty());
}

TEST(SpecTest, WritesValuesInTheirShortestForm) {
  EXPECT_EQ(parse_spec("sm,bias=1.0").canonical(), "uniform/depth/hard@2048");
  EXPECT_EQ(parse_spec("sm@2048,bias=-0").canonical(), "uniform/depth/hard@2048,bias=0");
  EXPECT_EQ(parse_spec("pcf,width=0.20,radius=3.0").canonical(), "uniform/depth/pcf@2048,radius=3,width=0.2");
  EXPECT_EQ(parse_spec("rmsm,finest=2048e1").canonical(), "paged/depth/trilinear@32768,finest=20480");
  EXPECT_EQ(parse_spec("cpvs,dynamic=(sm@2048)").canonical(), parse_spec("cpvs,dynamic=(uniform)").canonical());
}

TEST(SpecTest, CanonicalFormsParseToThemselves) {
  for (const char* text : {"sm", "pcf@4096,radius=4", "uniform/depth/pcf@100,fit=visible,width=1.5", "ray"})
    EXPECT_EQ(parse_spec(parse_spec(text).canonical()).canonical(), parse_spec(text).canonical());
}

TEST(SpecTest, RefusesWithAReason) {
  EXPECT_NE(refusal("").find("empty"), std::string::npos);
  EXPECT_NE(refusal("smm").find("no technique or parameterization 'smm'"), std::string::npos);
  EXPECT_NE(refusal("uniform/deep").find("no storage 'deep'"), std::string::npos);
  EXPECT_NE(refusal("uniform/depth/soft").find("no filter 'soft'"), std::string::npos);
  EXPECT_NE(refusal("uniform/depth/hard/x").find("more than"), std::string::npos);
  EXPECT_NE(refusal("sm@").find("resolution"), std::string::npos);
  EXPECT_NE(refusal("sm@12.5").find("resolution"), std::string::npos);
  EXPECT_NE(refusal("sm@99999999").find("resolution"), std::string::npos);
  EXPECT_NE(refusal("sm,").find("key=value"), std::string::npos);
  EXPECT_NE(refusal("sm,radius=2").find("belongs to 'pcf'"), std::string::npos);
  EXPECT_NE(refusal("pcf,radius=2.5").find("whole number"), std::string::npos);
  EXPECT_NE(refusal("pcf,radius=99").find("out of range"), std::string::npos);
  EXPECT_NE(refusal("sm,fit=tight").find("view, scene, visible"), std::string::npos);
  EXPECT_NE(refusal("sm,bias=1,bias=2").find("twice"), std::string::npos);
  EXPECT_NE(refusal("sm,bias=nan").find("out of range"), std::string::npos);
  EXPECT_NE(refusal("csm,cascades=9").find("1 to 8"), std::string::npos);
  EXPECT_NE(refusal("csm,lambda=2").find("out of range"), std::string::npos);
  EXPECT_NE(refusal("csm,splits=log").find("pssm, sdsm"), std::string::npos);
  EXPECT_NE(refusal("sm,cascades=2").find("belongs to 'cascaded'"), std::string::npos);
  EXPECT_NE(refusal("vsm,radius=2").find("averages beforehand"), std::string::npos);
  EXPECT_NE(refusal("vsm,blur=99").find("out of range"), std::string::npos);
  EXPECT_NE(refusal("uniform/moments/hard,blur=2").find("belongs to 'moments/pcf'"), std::string::npos);
  EXPECT_NE(refusal("pcf,bleeding=0.2").find("belongs to 'moments'"), std::string::npos);
  EXPECT_NE(refusal("uniform/moments/aa").find("makes no sense"), std::string::npos);
  EXPECT_NE(refusal("ray@5").find("neither"), std::string::npos);
  EXPECT_NE(refusal("cpvs@1000").find("power of two"), std::string::npos);
  EXPECT_NE(refusal("cpvs,taps=4").find("one of 1, 3"), std::string::npos);
  EXPECT_NE(refusal("cpvs,bias=2").find("belongs to 'map'"), std::string::npos);
  EXPECT_NE(refusal("cpvs,dynamic=sm").find("in parentheses"), std::string::npos);
  EXPECT_NE(refusal("cpvs,dynamic=(smm)").find("no technique"), std::string::npos);
  EXPECT_NE(refusal("cpvs,dynamic=(ray)").find("map technique"), std::string::npos);
  EXPECT_NE(refusal("cpvs,file=a.cpvs,static=1").find("is baked"), std::string::npos);
  EXPECT_NE(refusal("cpvs,static=1,dynamic=(sm)").find("static=1"), std::string::npos);
  EXPECT_NE(refusal("asm,refine=none").find("'asm' sets refine=edges itself; write paged/depth/trilinear instead"),
            std::string::npos);
  EXPECT_NE(refusal("precomputed/depth").find("neither"), std::string::npos);
  EXPECT_NE(refusal("uniform/depth/aa").find("makes no sense"), std::string::npos);
  EXPECT_NE(refusal("uniform/depth/trilinear").find("only paged maps"), std::string::npos);
}

TEST(SpecTest, RefusesUnbuiltPartsByName) {
  EXPECT_NE(refusal("paged/triangle").find("not built yet"), std::string::npos) << refusal("paged/triangle");
}

TEST(SpecTest, RefusesCascadesThatTheFilterFills) {
  EXPECT_NE(refusal("csm@20,radius=8").find("reaches 9.5 texels"), std::string::npos) << refusal("csm@20,radius=8");
  EXPECT_NE(refusal("csm@20,radius=8").find("give @22 or more, or a smaller radius"), std::string::npos);
  EXPECT_EQ(refusal("csm@22,radius=8"), "accepted");
  EXPECT_NE(refusal("csm@22,radius=8,stable=1").find("give @23"), std::string::npos);
  EXPECT_NE(refusal("cascaded/moments/pcf@34,blur=16").find("give @37 or more, or a smaller blur"), std::string::npos);
  EXPECT_EQ(refusal("cascaded/moments/pcf@37,blur=16"), "accepted");
  EXPECT_EQ(refusal("csm@16,width=1000"), "accepted");
}

TEST(SpecTest, KnowsWhichLightsATechniqueServes) {
  for (const char* text : {"sm", "psm", "rmsm", "spsm"})
    EXPECT_TRUE(serves(parse_spec(text), LightKind::point)) << text;
  for (const char* text : {"csm", "rtw", "cpvs"}) {
    EXPECT_FALSE(serves(parse_spec(text), LightKind::point)) << text;
    EXPECT_TRUE(serves(parse_spec(text), LightKind::spot)) << text;
  }
}

TEST(SpecTest, ATechniqueIsCheckedAgainstTheLight) {
  Light lamp;
  lamp.kind = LightKind::point;
  for (const char* text : {"sm", "rmsm", "ray"}) EXPECT_NO_THROW(check(parse_spec(text), {}, lamp)) << text;
  for (const char* text : {"csm", "cpvs"}) {
    EXPECT_THROW(check(parse_spec(text), {}, lamp), InputError) << text;
    EXPECT_NO_THROW(check(parse_spec(text), {}, sun(35, 45))) << text;
  }
}

TEST(SpecTest, SweepsByPowersOfTwo) {
  EXPECT_EQ(expand_sweep("sm@512..4096,bias=2"),
            (std::vector<std::string>{"sm@512,bias=2", "sm@1024,bias=2", "sm@2048,bias=2", "sm@4096,bias=2"}));
  EXPECT_EQ(expand_sweep("pcf@300..700"), (std::vector<std::string>{"pcf@300", "pcf@600"}));
  EXPECT_EQ(expand_sweep("cpvs@256,file=../x.cpvs"), std::vector<std::string>{"cpvs@256,file=../x.cpvs"});
  EXPECT_EQ(expand_sweep("cpvs,file=a@2..3"), std::vector<std::string>{"cpvs,file=a@2..3"});
  EXPECT_EQ(expand_sweep("cpvs@64..128,dynamic=(sm@2048)"),
            (std::vector<std::string>{"cpvs@64,dynamic=(sm@2048)", "cpvs@128,dynamic=(sm@2048)"}));
  EXPECT_EQ(expand_sweep("sm"), std::vector<std::string>{"sm"});
  EXPECT_THROW(expand_sweep("sm@1024..512"), InputError);
  EXPECT_THROW(expand_sweep("sm@1..x"), InputError);
}

TEST(SpecTest, HelpNamesEveryKey) {
  const std::string help = spec_help();
  for (const SpecKey& key : spec_keys()) EXPECT_NE(help.find(key.name), std::string::npos);
}

TEST(SpecTest, HelpTellsOfEveryCombination) {
  const std::string help = spec_help();
  EXPECT_NE(help.find("precomputed (directional and spot lights)"), std::string::npos) << help;
  EXPECT_NE(help.find("64 to 1048576 voxels (a power of two) per axis, 16384"), std::string::npos) << help;
  EXPECT_NE(help.find("Not built yet\n  uniform/subpixel/pcf"), std::string::npos) << help;
}

}  // namespace
}  // namespace shadewright::shadow
