// SPDX-License-Identifier: BSD-3-Clause
#include "bench/rivals.h"

#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletCollisionCommon.h>
#include <fcl/fcl.h>

#include <utility>

namespace ode_ext::bench {
namespace {

class FclRival : public Rival {
 public:
  FclRival(const char* name, fcl::CollisionRequestd request)
      : name_(name), request_(std::move(request)) {}

  const char* name() const override { return name_; }

  void add_mesh(const test::TestMesh& mesh) override {
    std::vector<fcl::Vector3d> vertices;
    std::vector<fcl::Triangle> triangles;
    for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.vertex_count()); ++i) {
      const test::Point p = mesh.vertex(i);
      vertices.emplace_back(p[0], p[1], p[2]);
    }
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
      triangles.emplace_back(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
    meshes_.push_back(std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>());
    meshes_.back()->beginModel();
    meshes_.back()->addSubModel(vertices, triangles);
    meshes_.back()->endModel();
  }

  void add_object(std::size_t mesh) override { objects_.emplace_back(meshes_[mesh]); }

  void place(std::size_t object, const test::TestPose& pose) override {
    fcl::Matrix3d rotation;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        rotation(r, c) = pose.rotation[static_cast<std::size_t>(3 * r + c)];
    objects_[object].setTransform(
        rotation, fcl::Vector3d(pose.position[0], pose.position[1], pose.position[2]));
  }

  bool collide(std::size_t a, std::size_t b) override {
    fcl::CollisionResultd result;
    fcl::collide(&objects_[a], &objects_[b], request_, result);
    return result.isCollision();
  }

 private:
  const char* name_;
  fcl::CollisionRequestd request_;
  std::vector<std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>>> meshes_;
  std::vector<fcl::CollisionObjectd> objects_;
};

class GimpactRival : public Rival {
 public:
  GimpactRival() { btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_); }

  const char* name() const override { return "GImpact"; }

  void add_mesh(const test::TestMesh& mesh) override {
    auto triangles = std::make_unique<btTriangleMesh>();
    const auto corner = [&](std::size_t i) {
      const test::Point p = mesh.vertex(mesh.indices[i]);
      return btVector3(static_cast<btScalar>(p[0]), static_cast<btScalar>(p[1]),
                       static_cast<btScalar>(p[2]));
    };
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
      triangles->addTriangle(corner(i), corner(i + 1), corner(i + 2));
    shapes_.push_back(std::make_unique<btGImpactMeshShape>(triangles.get()));
    shapes_.back()->setMargin(0);
    shapes_.back()->updateBound();
    meshes_.push_back(std::move(triangles));
  }

  void add_object(std::size_t mesh) override {
    objects_.push_back(std::make_unique<btCollisionObject>());
    objects_.back()->setCollisionShape(shapes_[mesh].get());
  }

  void place(std::size_t object, const test::TestPose& pose) override {
    const auto scalar = [](double value) { return static_cast<btScalar>(value); };
    btMatrix3x3 rotation;
    for (int r = 0; r < 3; ++r) {
      const auto row = static_cast<std::size_t>(3 * r);
      rotation[r].setValue(scalar(pose.rotation[row]), scalar(pose.rotation[row + 1]),
                           scalar(pose.rotation[row + 2]));
    }
    const btVector3 position(scalar(pose.position[0]), scalar(pose.position[1]),
                             scalar(pose.position[2]));
    objects_[object]->setWorldTransform(btTransform(rotation, position));
  }

  bool collide(std::size_t a, std::size_t b) override {
    const btCollisionObjectWrapper first(nullptr, objects_[a]->getCollisionShape(),
                                         objects_[a].get(), objects_[a]->getWorldTransform(), -1,
                                         -1);
    const btCollisionObjectWrapper second(nullptr, objects_[b]->getCollisionShape(),
                                          objects_[b].get(), objects_[b]->getWorldTransform(), -1,
                                          -1);
    btCollisionAlgorithm* algorithm =
        dispatcher_.findAlgorithm(&first, &second, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    btManifoldResult result(&first, &second);
    algorithm->processCollision(&first, &second, dispatch_, &result);
    btManifoldArray manifolds;
    algorithm->getAllContactManifolds(manifolds);
    bool found = false;
    for (int i = 0; i < manifolds.size(); ++i) found |= manifolds[i]->getNumContacts() > 0;
    algorithm->~btCollisionAlgorithm();
    dispatcher_.freeCollisionAlgorithm(algorithm);
    return found;
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDispatcherInfo dispatch_;
  std::vector<std::unique_ptr<btTriangleMesh>> meshes_;
  std::vector<std::unique_ptr<btGImpactMeshShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
};

}  // namespace

std::unique_ptr<Rival> make_fcl_all() {
  return std::make_unique<FclRival>("FCL all", fcl::CollisionRequestd(1000000, true));
}

std::unique_ptr<Rival> make_fcl_any() {
  return std::make_unique<FclRival>("FCL any", fcl::CollisionRequestd(1, false));
}

std::unique_ptr<Rival> make_gimpact() { return std::make_unique<GimpactRival>(); }

std::vector<std::unique_ptr<Rival>> make_rivals() {
  std::vector<std::unique_ptr<Rival>> rivals;
  rivals.push_back(make_fcl_all());
  rivals.push_back(make_fcl_any());
  rivals.push_back(make_gimpact());
  return rivals;
}

}  // namespace ode_ext::bench
