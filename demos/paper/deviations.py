# SPDX-License-Identifier: BSD-3-Clause
"""What is not as in the paper. Holds no result."""

TEXT = (
    "**Physics.** ODE steps the world on the host; the paper used Bullet 3 on the GPU, where poses "
    "already lie in device memory. Here they are uploaded in every pass and contacts read back.",
    "**Device.** The paper measured an AMD HD 7990. PoCL on a CPU vectorises nothing across "
    "work-items with divergent loops: it has no divergence to avoid, so the measured speed-ups of "
    "figures 6 and 7 are of less work and better locality only. What divergence would cost is "
    "counted instead, for groups of 32 and 64 lanes.",
    "**Synchronisation.** PoCL's queue is served by threads of the same process, so that a launch "
    "or a wait costs microseconds and crosses no bus: the milliseconds of table 1 cannot show "
    "there. How many waits are avoided is counted beside them.",
    "**Objects.** The paper's models are not public. Shapes of exactly their numbers of triangles "
    "(902, 2,130, 3,264 and 3,458) are generated (demos/meshes/shapes.h); the ground, the "
    "placement, masses and friction are ours too, and so is the number of pairs.",
    "**Sheets** are stopped by skins, copies of the objects and the ground that are grown a little "
    "(demos/meshes/inflate.h), since only vertices inside a mesh are seen: with them every "
    "object is two meshes. Objects meet each other as in the first scene. A pair with a sheet keeps "
    "all of its contacts.",
    "**Culls.** The paper dismisses a vertex by a bounding volume. Here chunks of 16 vertices are "
    "dismissed by their boxes first, then vertices by the target's box.",
    "**The baseline.** 'Without the pipeline' is one kernel per pair that marks its chunks in a dense "
    "list, then one with a work-item per vertex of every pair and a switch between the algorithms. "
    "It shares culls, data and the contact step with the pipeline. The paper says no more of its "
    "baseline than that it does not have the reorganization. The list is dense, and therefore most "
    "work-items leave at once; they are counted.",
    "**Iterative rays** follow the paper's rule: vertices without temporal data are dropped, and the "
    "triangle met by walking is taken for the first one. What that misses is counted. Checked by the "
    "BVH as far as that triangle (`iterative-checked`) nothing is missed, and nothing gained.",
    "**Temporal data** is kept by pair, on the device; up to commit 1c67fba all of it was void for "
    "one step whenever its memory grew, while the pile formed. Results of that commit have spikes "
    "there in figure 6b, and their table 2 counts what the predictions then missed.",
    "**Small displacement** is decided per pair and by the mean edge length of the target "
    "(`displacement_limit`); the paper gives no threshold.",
    "**Contacts.** An open surface, a grazing hit and a vertex on the surface have rules that are "
    "not in the paper (docs/architecture.md), and a pair of rigid meshes keeps at most 16 contacts.",
    "**Units of work.** A chunk looked at and a node visited count 1, a vertex looked at and a "
    "triangle tested 2, about their costs in box tests. Memory is not counted, and the pair step "
    "and the contact step, which are the same with and without the pipeline, are not either. "
    "Work-items are grouped in the order of their indices.",
    "**Measured steps.** A basic ray is tested against all 8,192 triangles of a sheet, which takes a "
    "processor very long, and counting work takes long too. Configurations that do either are "
    "measured in every K-th step only. They take part in the two steps before as well, so that "
    "temporal data and predictions are as in any other step. Counts of steps that were redone for "
    "larger buffers are left out.",
    "**Same poses.** All configurations collide the poses that one of them drives. In the paper "
    "each simulation was presumably its own, so a lost ray of table 2 would change what follows. "
    "The order of the configurations changes from step to step.",
    "**Predictions of what is lost.** Under *ignore* a buffer behind one that overflowed has not "
    "seen everything, so its count, and with it the next prediction, is a lower bound. There are "
    "more buffers here than in the paper, since chunks of vertices go through some of their own.",
    "**Table 2 without basic rays.** What is ignored has to be followed through every step, and basic "
    "rays are not cast in every step here. In the second scene rays at sheets go through refitted "
    "BVHs, two buffers of rays in place of three.",
    "**First step.** Without a history nothing is predicted: the first step is redone until "
    "everything fits, under *ignore* too.",
)
