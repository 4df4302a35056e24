// SPDX-License-Identifier: BSD-3-Clause
#include "audit/scene_audit.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace ode_ext::audit {
namespace {

using FclMesh = fcl::BVHModel<fcl::OBBRSSd>;
using Pairs = std::set<std::pair<dGeomID, dGeomID>>;

// An answer that changes when one mesh moves by this share of its size is nobody's mistake.
constexpr double kNudge = 1e-5;

std::pair<dGeomID, dGeomID> in_order(dGeomID a, dGeomID b) { return std::minmax(a, b); }

// The broad phase is ODE's own: nothing of the collider decides which pairs are looked at.
Pairs broad_phase(dSpaceID space) {
  Pairs pairs;
  dSpaceCollide(space, &pairs, [](void* data, dGeomID a, dGeomID b) {
    static_cast<Pairs*>(data)->insert(in_order(a, b));
  });
  return pairs;
}

std::shared_ptr<FclMesh> fcl_mesh(const falling_objects::TriangleMesh& mesh) {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 3)
    vertices.emplace_back(mesh.vertices[i], mesh.vertices[i + 1], mesh.vertices[i + 2]);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    triangles.emplace_back(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
  auto model = std::make_shared<FclMesh>();
  model->beginModel();
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

fcl::Transform3d fcl_pose(const oracle::Pose& pose, const oracle::Vector& offset) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const oracle::Vector& row = pose.rows[static_cast<std::size_t>(i)];
    result.linear().row(i) << row.x, row.y, row.z;
  }
  const oracle::Vector p = pose.position + offset;
  result.translation() << p.x, p.y, p.z;
  return result;
}

}  // namespace

struct SceneAudit::Body {
  explicit Body(const falling_objects::TriangleMesh& mesh)
      : surface(fcl_mesh(mesh)), solid(mesh.vertices, mesh.indices) {}
  std::shared_ptr<FclMesh> surface;
  oracle::Mesh solid;
};

struct SceneAudit::Placed {
  const Body* body;
  oracle::Pose pose;
};

namespace {

bool intersect(const FclMesh& a, const oracle::Pose& pa, const oracle::Vector& offset,
               const FclMesh& b, const oracle::Pose& pb) {
  const fcl::CollisionRequestd request(1, false);
  fcl::CollisionResultd result;
  fcl::collide(&a, fcl_pose(pa, offset), &b, fcl_pose(pb, {}), request, result);
  return result.isCollision();
}

bool first_vertex_inside(const oracle::Mesh& inner, const oracle::Pose& pi,
                         const oracle::Mesh& outer, const oracle::Pose& po) {
  return outer.signed_distance(po.to_local(pi.to_world(inner.vertices().front()))) < 0;
}

// [m] What the collider allows for rounding at this pair's coordinates (pair_step.cl); whatever is
// less deep than that is on the surface for it.
double rounding(const oracle::Mesh& a, const oracle::Pose& pa, const oracle::Mesh& b,
                const oracle::Pose& pb) {
  // sqrt(3): it adds up the components of the offset.
  const double offset = std::sqrt(3.0) * oracle::length(pa.position - pb.position);
  return 0x1p-20 * (offset + std::sqrt(3.0) * (a.radius() + b.radius()));
}

}  // namespace

Findings& Findings::operator+=(const Findings& other) {
  pairs += other.pairs;
  intersecting += other.intersecting;
  contained += other.contained;
  in_contact += other.in_contact;
  overlooked += other.overlooked;
  false_contacts += other.false_contacts;
  fragile += other.fragile;
  edges_only += other.edges_only;
  return *this;
}

SceneAudit::SceneAudit(const falling_objects::Scene& scene) : scene_(scene) {
  for (const falling_objects::Shape& shape : scene.shapes())
    bodies_.push_back(std::make_unique<Body>(shape.mesh));
  bodies_.push_back(std::make_unique<Body>(scene.ground().mesh()));
}

SceneAudit::~SceneAudit() = default;

SceneAudit::Placed SceneAudit::place(dGeomID geom) const {
  const std::size_t index = falling_objects::index_of(geom);
  const bool is_ground = index == scene_.objects().size();
  const dReal* p = dGeomGetPosition(geom);
  const dReal* r = dGeomGetRotation(geom);  // rows of four
  return {bodies_[is_ground ? scene_.shapes().size() : scene_.objects()[index].shape].get(),
          {{{{r[0], r[1], r[2]}, {r[4], r[5], r[6]}, {r[8], r[9], r[10]}}}, {p[0], p[1], p[2]}}};
}

Findings SceneAudit::look(std::span<const dContactGeom> contacts) const {
  Pairs in_contact;
  for (const dContactGeom& contact : contacts) in_contact.insert(in_order(contact.g1, contact.g2));
  Pairs pairs = broad_phase(scene_.space());
  pairs.insert(in_contact.begin(), in_contact.end());  // none that the broad phase did not see
  Findings findings;
  for (const auto& [a, b] : pairs)
    look_at_pair(place(a), place(b), in_contact.contains({a, b}), findings);
  return findings;
}

void SceneAudit::look_at_pair(const Placed& a, const Placed& b, bool has_contact,
                              Findings& findings) const {
  const auto intersect_moved = [&](const oracle::Vector& offset) {
    return intersect(*a.body->surface, a.pose, offset, *b.body->surface, b.pose);
  };
  const bool intersecting = intersect_moved({});
  const bool contained =
      !intersecting && (first_vertex_inside(a.body->solid, a.pose, b.body->solid, b.pose) ||
                        first_vertex_inside(b.body->solid, b.pose, a.body->solid, a.pose));
  ++findings.pairs;
  findings.intersecting += intersecting;
  findings.contained += contained;
  findings.in_contact += has_contact;
  if (has_contact == (intersecting || contained)) return;

  const double slack = rounding(a.body->solid, a.pose, b.body->solid, b.pose);
  const double size = std::min(a.body->solid.radius(), b.body->solid.radius());
  const double nudge = std::max(kNudge * size, slack);
  for (const double d : {-nudge, nudge}) {
    for (const oracle::Vector& offset :
         {oracle::Vector{d, 0, 0}, oracle::Vector{0, d, 0}, oracle::Vector{0, 0, d}}) {
      if (intersect_moved(offset) == intersecting) continue;
      ++findings.fragile;
      return;
    }
  }
  if (has_contact) {
    ++findings.false_contacts;
  } else if (oracle::penetration(a.body->solid, a.pose, b.body->solid, b.pose, slack) > slack) {
    ++findings.overlooked;
  } else {
    ++findings.edges_only;
  }
}

}  // namespace ode_ext::audit
