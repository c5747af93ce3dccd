#pragma once
// Tegument as a library: everything that a program needs to draw skin and fur, in one header.
//
// Link Tegument::assets, which makes what effects take from meshes (fur maps, strands, skin links, environment maps), caches it, and reads
// scenes as the command line does; or Tegument::host alone (host/run/session.h), which draws what it is given.
//
//     tegument::assets::JobOptions options;
//     options.file = "FurCoat";                            // an effect: a file, or the name of one of ours
//     options.scene.mesh = "scan.ply";                     // any mesh; without it the effect's own scene
//     auto job = tegument::assets::loadJob(options);       // 1. reads effect, mesh and values, and makes what they need
//     if (!job) return report(job.error());                //    errors are values: code, place, text, hint
//     auto device = tegument::gpu::Device::create();       // 2. a Vulkan device, headless
//     auto drawn = tegument::assets::draw(*device, *job);  // 3. compiles, draws, reads back: linear radiance
//     auto done = tegument::assets::writePicture("scan.png", drawn->image);
//
// Who owns what: a Job owns effect, meshes and scene; SessionScene and RunInput point into it, so it must outlive every Session. A Device
// must outlive its Sessions and textures. To draw many frames keep a Session(device, job->effect, assets::sessionScene(job->scene)) and
// call draw(job->scene.workspace, job->run): what did not change is not made again. One Session belongs to one thread at a time.

#include "host/gpu/gpu.h"
#include "host/image/image.h"
#include "host/mesh/mesh.h"
#include "host/run/run.h"
#include "host/run/session.h"
#include "host/support/result.h"
#include "meshprep/assets/job.h"
#include "meshprep/assets/picture.h"
