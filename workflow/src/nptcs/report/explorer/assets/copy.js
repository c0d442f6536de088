// What can be copied: commands and a block of the configuration.

function quoted(text) {
  return /^[\w.=@+-]+$/.test(text) ? text : `"${text}"`;
}

// `nptcs design` for the target band; with `held`, of this design alone.
function designCommand(held) {
  const study = studyOf();
  const solver = solverOf();
  const stiffness = rowsOf().find((row) => row.response?.name === "secant_stiffness");
  const surface = chosenSurface(stiffness.response) ?? stiffness.response.surfaces[0];
  const [low, high] = state.band;
  const goal = `K=${tidy((low + high) / 2)}+-${tidy((high - low) / 2)}@${tidy(state.load)}`;
  const parts = ["nptcs design", "--study", study.name, "--solver", solver.name, "--surface", quoted(surface.name)];
  parts.push("--target", quoted(goal));
  if (held) for (const name of study.factors) parts.push("--hold", `${name}=${tidy(state.values[name])}`);
  else {
    if (solver.responses.some((response) => response.name === "plate_mass")) parts.push("--minimise", "plate_mass");
    for (const [name, step] of Object.entries(study.steps)) parts.push("--step", `${name}=${tidy(step)}`);
  }
  return parts.join(" ");
}

// The design as a further case of its study.
function configBlock() {
  const study = studyOf();
  const values = study.factors.map((name) => `${name}: ${tidy(state.values[name])}`).join(", ");
  return `${say("config_lead", { study: study.name })}\n    further_cases:\n      - {${values}}\n`;
}
