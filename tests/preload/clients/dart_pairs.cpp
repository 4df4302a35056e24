// SPDX-License-Identifier: BSD-3-Clause
// A program of DART, whose ODE detector collides random meshes pass by pass, then a cube on a cube.
// Prints which pairs collide, and figures.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <dart/collision/ode/ode.hpp>
#include <dart/dynamics/MeshShape.hpp>
#include <dart/dynamics/SimpleFrame.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <random>
#include <set>
#include <stdexcept>

#include "support/arguments.h"

namespace {

using Frames = std::vector<std::shared_ptr<dart::dynamics::SimpleFrame>>;
using Random = std::mt19937_64;

// The distributions of the standard library differ between its versions; this does not.
double between(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

// A closed surface around the origin of 2 * kAround * (kAcross - 1) triangles, each vertex with a
// radius [m] of its own.
std::string rock(Random& random) {
  constexpr int kAround = 12, kAcross = 7;
  std::string text;
  const auto add = [&](double latitude, double longitude) {
    const double radius = between(random, 0.6, 1.2);
    text += "v " + std::to_string(radius * std::sin(latitude) * std::cos(longitude)) + " " +
            std::to_string(radius * std::sin(latitude) * std::sin(longitude)) + " " +
            std::to_string(radius * std::cos(latitude)) + "\n";
  };
  add(0, 0);
  for (int i = 1; i < kAcross; ++i)
    for (int k = 0; k < kAround; ++k) add(M_PI * i / kAcross, 2 * M_PI * k / kAround);
  add(M_PI, 0);
  // Numbered from 1: the pole, the rings, the other pole.
  const auto at = [](int ring, int k) { return 2 + ring * kAround + k % kAround; };
  const auto face = [&](int a, int b, int c) {
    text += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  };
  for (int k = 0; k < kAround; ++k) {
    face(1, at(0, k), at(0, k + 1));
    for (int ring = 0; ring + 2 < kAcross; ++ring) {
      face(at(ring, k), at(ring + 1, k), at(ring + 1, k + 1));
      face(at(ring, k), at(ring + 1, k + 1), at(ring, k + 1));
    }
    face(at(kAcross - 2, k + 1), at(kAcross - 2, k), at(kAcross - 1, 0));
  }
  return text;
}

std::string cube() {
  std::string text;
  for (int i = 0; i < 8; ++i) {
    text += "v";
    for (int k = 0; k < 3; ++k) text += (i >> k & 1) != 0 ? " 0.5" : " -0.5";
    text += "\n";
  }
  return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

// DART reads meshes from files.
dart::dynamics::ShapePtr shape_of(const std::string& text) {
  static int number = 0;
  const auto path =
      std::filesystem::temp_directory_path() /
      ("dart_pairs-" + std::to_string(getpid()) + "-" + std::to_string(number++) + ".obj");
  std::ofstream(path) << text;
  const aiScene* scene = dart::dynamics::MeshShape::loadMesh(path.string());
  std::filesystem::remove(path);
  if (scene == nullptr) throw std::runtime_error("DART cannot read " + path.string());
  return std::make_shared<dart::dynamics::MeshShape>(Eigen::Vector3d::Ones(), scene);
}

std::shared_ptr<dart::dynamics::SimpleFrame> frame_of(const dart::dynamics::ShapePtr& shape) {
  auto frame = std::make_shared<dart::dynamics::SimpleFrame>(dart::dynamics::Frame::World());
  frame->setShape(shape);
  return frame;
}

void place(dart::dynamics::SimpleFrame& frame, Random& random, double extent) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const auto coordinate = [&] { return between(random, 0, extent); };
  const auto angle = [&] { return between(random, -M_PI, M_PI); };
  const double x = coordinate(), y = coordinate(), z = coordinate();
  pose.translation() = Eigen::Vector3d(x, y, z);
  const double a = angle(), b = angle(), c = angle();
  pose.linear() = (Eigen::AngleAxisd(a, Eigen::Vector3d::UnitX()) *
                   Eigen::AngleAxisd(b, Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(c, Eigen::Vector3d::UnitZ()))
                      .toRotationMatrix();
  frame.setTransform(pose);
}

void collide_rocks(int passes, int bodies, double extent) {
  Random random(1);
  const auto detector = dart::collision::OdeCollisionDetector::create();
  const auto group = detector->createCollisionGroup();
  Frames frames;
  std::map<const dart::dynamics::Frame*, int> number;
  for (int i = 0; i < bodies; ++i) {
    frames.push_back(frame_of(shape_of(rock(random))));
    group->addShapeFrame(frames.back().get());
    number[frames.back().get()] = i;
  }
  const dart::collision::CollisionOption all(true, 10000000);
  std::size_t colliding = 0, contacts = 0;
  double seconds = 0, deepest = 0;
  for (int pass = 0; pass < passes; ++pass) {
    for (const auto& frame : frames) place(*frame, random, extent);
    dart::collision::CollisionResult result;
    const auto start = std::chrono::steady_clock::now();
    group->collide(all, &result);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::set<std::pair<int, int>> pairs;
    for (const auto& contact : result.getContacts()) {
      const int a = number.at(contact.collisionObject1->getShapeFrame());
      const int b = number.at(contact.collisionObject2->getShapeFrame());
      pairs.emplace(std::min(a, b), std::max(a, b));
      deepest = std::max(deepest, contact.penetrationDepth);
    }
    for (const auto& [a, b] : pairs)
      std::cout << "pair " << pass << ": " << a << " and " << b << " collide\n";
    colliding += pairs.size();
    contacts += result.getNumContacts();
  }
  std::cout << "figures: " << passes * (bodies * (bodies - 1) / 2) << " pairs of bodies, "
            << colliding << " collide, " << contacts << " contacts, the deepest " << deepest
            << ", in " << seconds << " s\n";
}

void collide_cubes() {
  const auto detector = dart::collision::OdeCollisionDetector::create();
  const auto group = detector->createCollisionGroup();
  const auto shape = shape_of(cube());
  const auto lower = frame_of(shape), upper = frame_of(shape);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().z() = 0.99;
  pose.linear() = Eigen::AngleAxisd(M_PI / 4, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  upper->setTransform(pose);
  group->addShapeFrame(lower.get());
  group->addShapeFrame(upper.get());
  dart::collision::CollisionResult result;
  group->collide(dart::collision::CollisionOption(true, 1000), &result);
  double deepest = 0;
  int sideways = 0;
  for (const auto& contact : result.getContacts()) {
    deepest = std::max(deepest, contact.penetrationDepth);
    sideways += std::fabs(contact.normal.z()) < 0.99 ? 1 : 0;
  }
  std::printf("figures: cube on cube, 0.010 deep: %zu contacts, the deepest %.3f, %d sideways\n",
              result.getNumContacts(), deepest, sideways);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Collides meshes by DART's ODE detector and prints which pairs collide.",
               "dart_pairs");
  int passes = 6, bodies = 16;
  double extent = 5;
  app.add_option("--passes", passes, "Of random poses");
  app.add_option("--bodies", bodies, "With a mesh of 144 triangles each");
  app.add_option("--extent", extent, "Edge of the cube that bodies are placed in [m]");
  if (const auto exit_code = parse_arguments(app, argc, argv)) return *exit_code;
  collide_cubes();
  collide_rocks(passes, bodies, extent);
  return EXIT_SUCCESS;
}
