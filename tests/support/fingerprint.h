// All that a job gives out and that must repeat, as text: a line an image, a plan, a pass's counts of work.
#pragma once

#include <algorithm>
#include <span>

#include "support/rendering.h"

namespace sundial::test {

// FNV-1a.
inline std::uint64_t hashOf(std::span<const std::byte> bytes) {
  std::uint64_t hash = 14695981039346656037u;
  for (const std::byte byte : bytes) hash = (hash ^ static_cast<std::uint64_t>(byte)) * 1099511628211u;
  return hash;
}

// Every row of the table, small, and a few with other parameters.
inline std::vector<Method> fingerprintMethods() {
  std::vector<Method> methods = {method("dv,texels=700x500"), method("dv,texels=512,lookup=pcf,kernel=5"),
                                 method("csm,texels=256,choose=depth,blend=0.2"),
                                 method("sdsm-log,texels=256,plan=readback")};
  for (const MethodRow& row : methodTable()) {
    const bool sized =
        std::ranges::any_of(parametersOf(row), [](const Parameter& p) { return p.name == "texels"; });
    methods.push_back(method(fmt::format("{}{}", row.name, sized ? ",texels=256" : "")));
  }
  return methods;
}

// Scenes, views and lights that reach every pass: opaque and masked clusters, a sun and a spot.
inline std::vector<RenderJob> fingerprintJobs() {
  std::vector<RenderJob> jobs;
  for (const auto& [name, view, light] :
       {std::tuple("atrium", "main", "sun"), {"trees?count=50", "walk", "spot"}, {"grid", "low", "low"}}) {
    const auto scene = builtin(name);
    jobs.push_back(
        jobOf(scene, viewOf(*scene, view), lightOf(*scene, light), {250, 203}, {}, kAllImages, true));
    jobs.back().methods = fingerprintMethods();
    if (std::ranges::any_of(scene->materials, &MaterialInfo::masked))
      std::erase_if(jobs.back().methods,
                    [](const Method& m) { return m.row->technique == Technique::shadowVolumes; });
  }
  return jobs;
}

inline std::string fingerprint(const Rendering& r) {
  const std::string label = r.result.method.label();
  std::string lines;
  for (const Aov aov : kAllImages)
    lines += fmt::format("{} {} {:016x}\n", label, aovName(aov), hashOf(r.images.at(aov).bytes));
  for (const PlanView& view : r.plan)
    lines += fmt::format("{} plan {:016x} {:016x}\n", label, hashOf(std::as_bytes(std::span(&view.gpu, 1))),
                         hashOf(std::as_bytes(std::span(&view.shadowFromWorld, 1))));
  for (const PassTiming& pass : r.result.passes) {
    lines += fmt::format("{} {}", label, pass.name);
    for (const Work& work : pass.work) lines += fmt::format(" {} {}", work.count, work.name);
    lines += '\n';
  }
  const Measures& m = *r.result.measures;
  lines += fmt::format("{} measures {} {} {} {} {} {} {}\n", label, m.pixelMatch, m.falseLit, m.falseShadow,
                       m.meanAbsError, m.interiorError, m.texelPx.p95, m.utilisation);
  return lines;
}

inline std::string fingerprint(Renderer& renderer, const RenderJob& job) {
  Collector collector;
  const Result<void> done = renderer.run(job, {}, collector);
  if (!done) throw std::runtime_error(done.error().message);
  std::string lines;
  for (const Rendering& r : collector.renderings) lines += fingerprint(r);
  return lines;
}

}  // namespace sundial::test
