// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/simulation.h"

#include <algorithm>
#include <chrono>

#include "simulation/speeds.h"

namespace falling_objects {
namespace {

double ms_since(std::chrono::steady_clock::time_point start) {
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  return took.count();
}

// All but mu, which depends on what touches.
dSurfaceParameters surface_of(const ContactSettings& settings) {
  dSurfaceParameters surface{};
  surface.mode = dContactApprox1;
  if (settings.bounce > 0) {
    surface.mode |= dContactBounce;
    surface.bounce = settings.bounce;
    surface.bounce_vel = settings.bounce_speed;
  }
  if (settings.soft_erp) {
    surface.mode |= dContactSoftERP;
    surface.soft_erp = *settings.soft_erp;
  }
  if (settings.soft_cfm) {
    surface.mode |= dContactSoftCFM;
    surface.soft_cfm = *settings.soft_cfm;
  }
  return surface;
}

}  // namespace

Simulation::Simulation(const SimulationSettings& settings, Scene& scene, Collision& collision,
                       Sheets* sheets)
    : settings_(settings),
      scene_(scene),
      collision_(collision),
      sheets_(sheets),
      contacts_(settings.max_contacts),
      compared_(settings.max_contacts),
      joints_(dJointGroupCreate(0)) {}

Simulation::~Simulation() { dJointGroupDestroy(joints_); }

StepRecord Simulation::step() {
  StepRecord record;
  record.step = steps_++;
  if (sheets_ != nullptr) show_sheets(record);
  collide(record);
  if (sheets_ != nullptr) move_sheets(record);
  advance(record);
  record.mean_speed = mean(speeds(scene_));
  return record;
}

void Simulation::collide(StepRecord& record) {
  const auto run = [&](Collider collider) {
    ContactList& list = collider == settings_.collider ? contacts_ : compared_;
    const double ms = collision_.collide(collider, list);
    const auto count = static_cast<long long>(list.contacts().size());
    if (collider == Collider::kBatch) {
      record.batch_ms = ms;
      record.batch_contacts = count;
    } else {
      record.ode_ms = ms;
      record.ode_contacts = count;
    }
  };
  if (settings_.compare) {
    // The second finds warm caches: they take turns at it.
    const bool batch_first = record.step % 2 == 0;
    run(batch_first ? Collider::kBatch : Collider::kOde);
    run(batch_first ? Collider::kOde : Collider::kBatch);
  } else {
    run(settings_.collider);
  }
  record.collide_ms = settings_.collider == Collider::kBatch ? record.batch_ms : record.ode_ms;

  record.pairs = contacts_.pairs();
  record.colliding_pairs = contacts_.colliding_pairs();
  record.contacts = static_cast<long long>(contacts_.contacts().size());
  for (const dContactGeom& contact : contacts_.contacts()) {
    if (scene_.touches_sheet(contact)) {
      ++record.sheet_contacts;
      continue;
    }
    record.deepest_contact = std::max(record.deepest_contact, static_cast<double>(contact.depth));
  }
  hash_ = hash_contacts(contacts_.contacts(), hash_);
  collision_.note(record);
}

void Simulation::show_sheets(StepRecord& record) {
  const auto start = std::chrono::steady_clock::now();
  sheets_->show(1 / settings_.hz);
  record.cloth_ms += ms_since(start);
}

// The sheets follow the bodies, which the collider saw where they are now; what they push back with
// acts in the step of the world that follows.
void Simulation::move_sheets(StepRecord& record) {
  const auto start = std::chrono::steady_clock::now();
  sheets_->step(1 / settings_.hz, contacts_.contacts());
  record.cloth_ms += ms_since(start);
  record.fastest_vertex = sheets_->fastest();
}

void Simulation::advance(StepRecord& record) {
  const auto start = std::chrono::steady_clock::now();
  record.solver_ms = advance_world(scene_, joints_, contacts_.contacts(), settings_.hz);
  record.world_ms = ms_since(start);
}

double advance_world(Scene& scene, dJointGroupID joints, std::span<const dContactGeom> contacts,
                     double hz) {
  dContact contact{};
  contact.surface = surface_of(scene.description().contact);
  for (const dContactGeom& geom : contacts) {
    if (scene.touches_sheet(geom)) continue;  // Sheets::step's business
    contact.geom = geom;
    contact.surface.mu = scene.mu_between(index_of(geom.g1), index_of(geom.g2));
    dJointID joint = dJointCreateContact(scene.world(), joints, &contact);
    dJointAttach(joint, dGeomGetBody(geom.g1), dGeomGetBody(geom.g2));
  }
  const auto start = std::chrono::steady_clock::now();
  if (scene.description().world.solver == Solver::kQuick) {
    dWorldQuickStep(scene.world(), 1 / hz);
  } else {
    dWorldStep(scene.world(), 1 / hz);
  }
  const double solver_ms = ms_since(start);
  dJointGroupEmpty(joints);
  return solver_ms;
}

}  // namespace falling_objects
