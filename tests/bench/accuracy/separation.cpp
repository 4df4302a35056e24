// SPDX-License-Identifier: BSD-3-Clause
// Convex pairs, pushed apart by what the collider says: the first along the normal of the deepest
// contact by its depth, at most five times, with fresh contacts each time.
#include <memory>

#include "bench/accuracy/failures.h"
#include "bench/accuracy/measures.h"
#include "bench/accuracy/pressed_pair.h"
#include "bench/accuracy/trial.h"
#include "support/convex_makers.h"

namespace ode_ext::accuracy {
namespace {

using test::operator+;
using test::operator*;

constexpr double kPressed = 0.05;  // of the smaller size
constexpr int kMoves = 5;
constexpr double kLongestWay = 1.5;  // times the shortest

// [of the smaller size] What may remain. The collider cannot see less than 2^-20 of the pair's
// extents (that is a touch to it, of next to no depth): sqrt(3) times the offset and the radii of
// two bodies of which one is twice as large as the other, 9 sizes in all, make 1e-5. Each of the
// five moves can leave as much.
constexpr double kRemains = 1e-4;

// [of the smaller size] A move by less is none: a touch is 2^-48 of the radii deep.
constexpr double kLeastMove = 1e-12;

struct Scene {
  const Body *a, *b;
  PressedPair pair;
  test::GeomPair geoms;
};

struct Scenes {
  std::vector<Body> bodies;
  std::vector<Scene> scenes;
  Share libccd_differing;
};

std::vector<Body> make_bodies(test::Random& random, test::OdeWorld& world) {
  std::vector<Body> bodies;
  for (const double size : {0.6, 1.0}) {
    for (const test::TestMesh& mesh :
         {test::make_cube(size), test::make_tetrahedron(1.4 * size),
          test::make_octahedron(size / 2), test::make_icosphere(size / 2, 1),
          test::make_cylinder(size / 3, size, 16), test::make_random_hull(random, 20, size / 2),
          test::make_random_hull(random, 20, size / 2),
          test::make_ellipsoid({size / 2, size / 3, size / 4}, 1)})
      bodies.emplace_back(world, mesh);
  }
  return bodies;
}

std::shared_ptr<const Scenes> make_scenes(const Options& options, test::OdeWorld& world) {
  test::Random random(options.seed);
  const auto made = std::make_shared<Scenes>();
  made->bodies = make_bodies(random, world);
  const auto any = [&] {
    return &made->bodies[static_cast<std::size_t>(
        random.below(static_cast<int>(made->bodies.size())))];
  };
  for (int i = 0; i < options.count_or(1000); ++i) {
    const Body *a = any(), *b = any();
    const PressedPair pair = press_together(*a, *b, kPressed, random);
    made->libccd_differing.count(libccd_differs(*a, *b, pair));
    made->scenes.push_back(
        {a, b, pair, {world.geom(a->mesh, pair.pa), world.geom(b->mesh, pair.pb)}});
  }
  return made;
}

struct Course {
  test::TestPose pose;
  double way = 0;  // [m]
  int moves = 0;
  bool apart = false, stuck = false;  // stuck: no contact, but not apart
};

void move_along(const Scene& scene, const test::Contacts& contacts, Course& course) {
  const dContactGeom* deepest = deepest_of(contacts);
  course.stuck = deepest == nullptr || !(deepest->depth > kLeastMove * scene.pair.size);
  if (course.stuck) return;
  course.pose.position = course.pose.position + deepest->depth * test::normal(*deepest);
  course.way += deepest->depth;
  ++course.moves;
  test::set_pose(scene.geoms.first, course.pose);
  const auto out = shortest_way_out(scene.a->solid, course.pose, scene.b->solid, scene.pair.pb);
  course.apart = out.depth < kRemains * scene.pair.size;
}

std::vector<Course> push_apart(const std::vector<Scene>& scenes, Contestant& contestant) {
  std::vector<Course> courses;
  for (const Scene& scene : scenes) {
    courses.push_back({scene.pair.pa});
    test::set_pose(scene.geoms.first, scene.pair.pa);
  }
  for (int move = 0; move < kMoves; ++move) {
    std::vector<std::size_t> moving;
    std::vector<test::GeomPair> geoms;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      if (courses[i].apart || courses[i].stuck) continue;
      moving.push_back(i);
      geoms.push_back(scenes[i].geoms);
    }
    const auto answers = contestant.collide(geoms);
    for (std::size_t k = 0; k < moving.size(); ++k)
      move_along(scenes[moving[k]], answers[k], courses[moving[k]]);
  }
  return courses;
}

}  // namespace

Measure prepare_separation(const Options& options, test::OdeWorld& world) {
  return [made = make_scenes(options, world)](Contestant& contestant) {
    const auto courses = push_apart(made->scenes, contestant);
    Share none, apart, at_once, short_way;
    Failures failures;
    for (std::size_t i = 0; i < courses.size(); ++i) {
      const Course& course = courses[i];
      none.count(course.stuck && course.moves == 0);
      apart.count(course.apart);
      at_once.count(course.apart && course.moves == 1);
      const Scene& scene = made->scenes[i];
      short_way.count(course.apart && course.way <= kLongestWay * scene.pair.out.depth);
      test::set_pose(scene.geoms.first, scene.pair.pa);  // as it was, for whoever looks at it
      if (!course.apart) {
        failures.add(std::to_string(course.moves) + " moves and " +
                         (course.stuck ? "no contact, but not apart" : "not apart"),
                     scene.geoms);
      }
    }
    return Outcome{
        {{"apart after five moves [%]", apart.percent(), at_least(99)},
         {"on a way of at most 1.5 times the shortest [%]", short_way.percent(), at_least(95)},
         {"apart after the first move [%]", at_once.percent()},
         {"pairs without a contact [%]", none.percent()},
         {"(libccd differs from the truth [%])", made->libccd_differing.percent()}},
        {{"failures", failures.json()}}};
  };
}

}  // namespace ode_ext::accuracy
