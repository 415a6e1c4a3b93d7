// The visible fraction against the truth, on each device.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "bake/baked_irradiance.h"
#include "bake/charts.h"
#include "bake/driver.h"
#include "shadow/oracle.h"

namespace penumbra::bake {
namespace {

class OnOracle : public ::testing::TestWithParam<std::tuple<std::string, BakeDevice>> {
 protected:
  void SetUp() override { skip_without_driver(std::get<1>(GetParam())); }
};
INSTANTIATE_TEST_SUITE_P(Scenes, OnOracle,
                         ::testing::Combine(::testing::ValuesIn(testing::oracle_names()),
                                            ::testing::Values(BakeDevice::cpu, BakeDevice::gl,
                                                              BakeDevice::rays)),
                         [](const auto& param) {
                           std::string name = std::get<0>(param.param);
                           std::erase(name, '-');
                           return name + name_of(std::get<1>(param.param));
                         });

TEST_P(OnOracle, IsMetWithin2Percent) {
  const auto& [name, device] = GetParam();
  const testing::Oracle oracle(name);
  const World world(oracle.scene);
  BakeOptions options;
  options.device = device;
  options.light_samples = 256;
  const BakedIrradiance baked(world, options);
  double squares = 0;
  for (const testing::OraclePoint& p : oracle.points) {
    float found = 0;
    baked.visible_fractions(chart_at(p.receiver.position, p.receiver.normal), p.light,
                            std::span(&found, 1));
    squares += std::pow(found - p.truth, 2);
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(oracle.points.size())), 0.02);
}

}  // namespace
}  // namespace penumbra::bake
