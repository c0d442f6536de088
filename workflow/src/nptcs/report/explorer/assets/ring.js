// The deformed ring: solved by the load-bearing analysis with spokes that give the displacement of
// the chosen model.

// Rubbers of this design: the sliders' values, or those that the study holds.
function rubbersOf(study) {
  return ["shear_band_c10_mpa", "spoke_c10_mpa"].map((name) => valueOf(name, study));
}

// The solved wheel of this design, or the words that say why there is none.
function solvedRing(study, displacement) {
  const plain = DATA.ring;
  if (!plain) return { words: say("ring_none") };
  const [band, spoke] = rubbersOf(study);
  if (!(band > 0) || !(spoke > 0)) return { words: say("ring_unknown") };
  const wheel = wheelOf(plain, band, spoke);
  const knots = plain.c10_mpa;
  if (!wheel) {
    return { words: say("ring_outside", { table: plain.table, low: tidy(knots[0]), high: tidy(knots.at(-1)) }) };
  }
  const solved = displacement > 0 ? wheelWithDisplacement(wheel, state.load, displacement) : solveWheel(wheel, state.load);
  if (!solved) return { words: say("ring_unsolved") };
  const values = {
    band: tidy(band),
    spoke: tidy(spoke),
    table: plain.table,
    factor: solved.factor.toFixed(3),
    delta: solved.displacement.toFixed(2),
    length: solved.contactLength.toFixed(1),
    contact: ((solved.thetaC * 180) / Math.PI).toFixed(2),
    transition: ((solved.thetaT * 180) / Math.PI).toFixed(1),
  };
  const alt = say("ring_alt", { load: tidy(state.load), delta: values.delta, length: values.length });
  return { solved, words: say(displacement > 0 ? "ring_from" : "ring_own", values), alt };
}

const RING_STEPS = 180;

function drawRing(canvas, solved) {
  const { context, width, height } = prepared(canvas);
  const plain = solved.wheel.plain;
  const radius = plain.radius_mm;
  const scale = Math.min(width, height) / (2 * plain.outer_radius_mm + 12);
  const centre = [width / 2, height / 2];
  const at = (r, angle) => [centre[0] + scale * r * Math.sin(angle), centre[1] + scale * r * Math.cos(angle)];
  const angles = Array.from({ length: 2 * RING_STEPS + 1 }, (_, i) => ((i - RING_STEPS) / RING_STEPS) * Math.PI);
  const moved = displacementsAt(solved, angles).map(([u, v], i) => {
    const angle = angles[i];
    const [r, t] = [radius + u, v];
    return [
      centre[0] + scale * (r * Math.sin(angle) + t * Math.cos(angle)),
      centre[1] + scale * (r * Math.cos(angle) - t * Math.sin(angle)),
    ];
  });
  context.strokeStyle = COLOURS.soft;
  context.lineWidth = 1;
  const ground = centre[1] + scale * (radius - solved.displacement);
  line(context, [[centre[0] - scale * radius, ground], [centre[0] + scale * radius, ground]]);
  context.setLineDash([4, 4]);
  line(context, angles.map((angle) => at(radius, angle)));
  context.setLineDash([]);
  spokes(context, solved, at, angles, moved);
  context.strokeStyle = COLOURS.ink;
  context.lineWidth = 1.6;
  line(context, angles.map((angle) => at(plain.rim_radius_mm, angle)));
  context.strokeStyle = COLOURS.model;
  context.lineWidth = 3;
  line(context, moved);
}

// One line per spoke from the rim to the ring, coloured by the sign of its force.
function spokes(context, solved, at, angles, moved) {
  const count = solved.wheel.plain.spoke_count;
  context.lineWidth = 1.3;
  for (let k = 0; k < count; k++) {
    const angle = ((2 * k) / count - 1) * Math.PI;
    const place = Math.round(((angle + Math.PI) / (2 * Math.PI)) * (angles.length - 1));
    context.strokeStyle = Math.abs(angle) > solved.thetaT ? COLOURS.tension : COLOURS.compression;
    line(context, [at(solved.wheel.plain.rim_radius_mm, angle), moved[place]]);
  }
}
