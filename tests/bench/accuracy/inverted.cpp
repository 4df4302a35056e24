// SPDX-License-Identifier: BSD-3-Clause
// Meshes whose triangles are wound the wrong way round. A closed surface has but one inside, so the
// contacts have to be those of the mesh wound rightly. Where a list is as long as the collider lets
// it be, others were left out, and which ones may hang on rounding: there the deepest has to be the
// same.
#include <algorithm>
#include <array>
#include <cmath>

#include "bench/accuracy/contact_match.h"
#include "bench/accuracy/failures.h"
#include "bench/accuracy/measures.h"
#include "bench/accuracy/rounding.h"
#include "bench/accuracy/trial.h"

namespace ode_ext::accuracy {
namespace {

// A ball with bumps and dents.
test::TestMesh make_bumpy(double radius) {
  test::TestMesh mesh = test::make_icosphere(radius, 2);
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) {
    const test::Point p = mesh.vertex(i / 3);
    const double bump = 1 + 0.25 * std::sin(7 * p[0] / radius) * std::sin(5 * p[1] / radius + 1);
    for (std::size_t k = 0; k < 3; ++k) mesh.vertices[i + k] = static_cast<float>(bump * p[k]);
  }
  return mesh;
}

constexpr const char* kInverted[] = {"none", "the first", "the second", "both"};

struct Scene {
  // Both as they are, the first inverted, the second, both.
  std::array<test::GeomPair, 4> geoms;
  double tolerance;  // [m] computing on corners in another order is within rounding
};

std::vector<Scene> make_scenes(const Options& options, test::OdeWorld& world) {
  test::Random random(options.seed);
  struct Kind {
    const test::OdeMesh *as_is, *inverted;
  };
  std::vector<Kind> kinds;
  for (const test::TestMesh& mesh :
       {test::make_torus(0.5, 0.2, 24, 12), test::make_l(1), make_bumpy(0.6)})
    kinds.push_back({&world.mesh(mesh), &world.mesh(test::inverted(mesh))});
  std::vector<Scene> scenes;
  for (int i = 0; i < options.count_or(500); ++i) {
    const Kind& a = kinds[static_cast<std::size_t>(random.below(3))];
    const Kind& b = kinds[static_cast<std::size_t>(random.below(3))];
    const test::TestPose pa = random.pose(0.5), pb = random.pose(0.5);
    const auto geoms = [&](const test::OdeMesh* ma, const test::OdeMesh* mb) {
      return test::GeomPair{world.geom(*ma, pa), world.geom(*mb, pb)};
    };
    scenes.push_back({{geoms(a.as_is, b.as_is), geoms(a.inverted, b.as_is),
                       geoms(a.as_is, b.inverted), geoms(a.inverted, b.inverted)},
                      rounding(a.as_is->mesh(), pa, b.as_is->mesh(), pb)});
  }
  return scenes;
}

test::Contacts deepest_alone(const test::Contacts& contacts) {
  const dContactGeom* deepest = deepest_of(contacts);
  return deepest == nullptr ? test::Contacts{} : test::Contacts{*deepest};
}

}  // namespace

Measure prepare_inverted(const Options& options, test::OdeWorld& world) {
  return [scenes = make_scenes(options, world)](Contestant& contestant) {
    std::vector<test::GeomPair> geoms;
    for (const Scene& scene : scenes)
      geoms.insert(geoms.end(), scene.geoms.begin(), scene.geoms.end());
    const auto answers = contestant.collide(geoms);
    Failures failures;
    Share colliding, whole, differing, deepest_differing, opposed;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      const test::Contacts& truth = answers[4 * i];
      colliding.count(!truth.empty());
      for (std::size_t k = 1; k < 4; ++k) {
        const test::Contacts& other = answers[4 * i + k];
        if (truth.empty() && other.empty()) continue;
        const bool is_whole = std::max(truth.size(), other.size()) < contestant.limit();
        whole.count(is_whole);
        const bool differs = is_whole && !same_contacts(truth, other, scenes[i].tolerance);
        if (is_whole) differing.count(differs);
        const auto one = deepest_alone(truth), two = deepest_alone(other);
        const bool deepest_differs = !same_contacts(one, two, scenes[i].tolerance);
        deepest_differing.count(deepest_differs);
        if (differs || deepest_differs) {
          failures.add(std::to_string(truth.size()) + " contacts, " + std::to_string(other.size()) +
                           " with " + kInverted[k] + " inverted" +
                           (deepest_differs ? ", another deepest" : ""),
                       scenes[i].geoms[k]);
        }
        opposed.count(one.empty() || two.empty() ||
                      test::dot(test::normal(one[0]), test::normal(two[0])) < 0);
      }
    }
    return Outcome{
        {{"pairs with other contacts, of those with none left out [%]", differing.percent(),
          at_most(0)},
         {"pairs with another deepest contact [%]", deepest_differing.percent(), at_most(0)},
         {"pairs whose deepest contact pushes the other way, or is none [%]", opposed.percent()},
         {"(poses with contacts [%])", colliding.percent()},
         {"(pairs with none left out [%])", whole.percent()}},
        {{"failures", failures.json()}}};
  };
}

}  // namespace ode_ext::accuracy
