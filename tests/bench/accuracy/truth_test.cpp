// SPDX-License-Identifier: BSD-3-Clause
// The trials judge colliders that are known to be right, wrong or silent as they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

#include "bench/accuracy/report.h"
#include "support/convex_solid.h"

namespace ode_ext::accuracy {
namespace {

using test::operator+;
using test::operator*;

// The surface as it is in the world; corners at one place become one vertex.
test::TestMesh mesh_of(dGeomID geom) {
  test::TestMesh mesh;
  std::map<test::Point, unsigned> known;
  for (int t = 0; t < dGeomTriMeshGetTriangleCount(geom); ++t) {
    dVector3 corners[3];
    dGeomTriMeshGetTriangle(geom, t, &corners[0], &corners[1], &corners[2]);
    for (const dReal* c : corners) {
      const auto [found, is_new] =
          known.try_emplace(test::Point{c[0], c[1], c[2]}, mesh.vertex_count());
      if (is_new) {
        for (std::size_t k = 0; k < 3; ++k) mesh.vertices.push_back(static_cast<float>(c[k]));
      }
      mesh.indices.push_back(found->second);
    }
  }
  return mesh;
}

// One contact per pair, the least separation of convex meshes, changed as the test wants.
class Oracle : public Contestant {
 public:
  using Change = void (*)(test::Contacts&);
  explicit Oracle(Change change = nullptr) : change_(change) {}

  std::vector<test::Contacts> collide(std::span<const test::GeomPair> pairs) override {
    std::vector<test::Contacts> answers;
    for (const auto& [g1, g2] : pairs) {
      // All axes of the balls by formula are too many.
      if (std::max(dGeomTriMeshGetTriangleCount(g1), dGeomTriMeshGetTriangleCount(g2)) > 1000) {
        answers.emplace_back();
        continue;
      }
      const test::ConvexSolid a(mesh_of(g1)), b(mesh_of(g2));
      const test::WayOut out = shortest_way_out(a, {}, b, {});
      test::Contacts contacts;
      if (out.depth > 0) {
        dContactGeom contact{};
        contact.depth = out.depth;
        for (std::size_t k = 0; k < 3; ++k) contact.normal[k] = out.direction[k];
        contacts.push_back(contact);
      }
      if (change_ != nullptr) change_(contacts);
      answers.push_back(contacts);
    }
    return answers;
  }
  std::size_t limit() const override { return 16; }

 private:
  Change change_;
};

void turn_round(test::Contacts& contacts) {
  for (dContactGeom& c : contacts) {
    for (int k = 0; k < 3; ++k) c.normal[k] = -c.normal[k];
  }
}
void double_depth(test::Contacts& contacts) {
  for (dContactGeom& c : contacts) c.depth *= 2.01;
}
void say_nothing(test::Contacts& contacts) { contacts.clear(); }

class JudgedTrial : public testing::TestWithParam<const char*> {
 protected:
  bool is(const char* trial) const { return std::string(GetParam()) == trial; }

  // The figures whose targets the contestant misses, or what else failed.
  std::string missed(Oracle::Change change) {
    Oracle oracle(change);
    const Outcome outcome = measure_(oracle);
    if (is("coincident")) return names_of(outcome.details.at("failures"));
    std::string names;
    for (const Figure& f : outcome.figures) {
      if (f.target && !f.target->met_by(f.value)) names += f.name + "; ";
    }
    return names;
  }

 private:
  static std::string names_of(const nlohmann::json& failures) {
    std::string names;
    for (const auto& failure : failures.at("first"))
      names += failure.at("what").get<std::string>() + "; ";
    return names;
  }

  const Trial& trial() const {
    for (const Trial& trial : all_trials()) {
      if (std::string(trial.name) == GetParam()) return trial;
    }
    throw std::logic_error("no such trial");
  }

  test::OdeWorld world_;
  Measure measure_ = trial().prepare({.seed = 11, .count = 40}, world_);
};

TEST_P(JudgedTrial, IsPassedByTheTruth) {
  // The oracle knows convex meshes only.
  const char* const torus = "copy: torus: no contact; copy: torus, turned: no contact; ";
  EXPECT_EQ(missed(nullptr), is("coincident") ? torus : "");
}

TEST_P(JudgedTrial, IsFailedByNormalsTurnedRound) {
  if (is("coincident")) return;  // it asks that normals do not oppose each other, not for signs
  EXPECT_NE(missed(turn_round), "");
}

TEST_P(JudgedTrial, IsFailedBySilence) { EXPECT_NE(missed(say_nothing), ""); }

TEST_P(JudgedTrial, IsFailedByDepthsTwiceTooLarge) {
  if (is("plate")) return;  // its target is the normal
  EXPECT_NE(missed(double_depth), "");
}

INSTANTIATE_TEST_SUITE_P(Accuracy, JudgedTrial,
                         testing::Values("cubes", "rods", "plate", "separation", "coincident"),
                         [](const auto& trial) { return std::string(trial.param); });

TEST(JudgedTable, IsOffByNothingForTheTruthAndByWhatADepthIsOff) {
  test::OdeWorld world;
  const Measure measure = prepare_table({.seed = 11, .count = 2}, world);
  Oracle truth, twice(double_depth);
  int judged = 0;
  const nlohmann::json true_rows = measure(truth).details, wrong_rows = measure(twice).details;
  for (std::size_t i = 0; i < true_rows.size(); ++i) {
    if (true_rows[i]["none"] == 100) continue;  // by formula
    EXPECT_LT(true_rows[i]["depth_worst"], 0.1) << true_rows[i];
    EXPECT_LT(true_rows[i]["angle_worst"], 0.1) << true_rows[i];
    EXPECT_NEAR(wrong_rows[i]["depth_worst"].get<double>(), 101, 0.3) << wrong_rows[i];
    ++judged;
  }
  EXPECT_EQ(judged, 50);
}

}  // namespace
}  // namespace ode_ext::accuracy
