// From the state to the page: the plane and the list of models follow when a slider rests.

let later = 0;

function show() {
  readColours(ROOT);
  settleShown();
  const study = studyOf();
  const solver = solverOf();
  const point = pointOf(study, solver);
  showControls();
  showPlates(study, solver);
  showWarning(study, solver, point);
  showResults(point, study, solver);
  showProfiles(point, study, solver);
  showRing(point, study, solver);
  showCurve(point, study, solver);
  clearTimeout(later);
  later = setTimeout(() => {
    showPlane(point, study, solver);
    showModels(study);
  }, PAUSE_MS);
}

let waiting = false;

// Draw at the next frame, however many changes come before it, and keep the state in the address.
function changed() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    show();
    if (location.hash.slice(1) !== stateText()) history.replaceState(null, "", `#${stateText()}`);
  });
}

function start() {
  build();
  resetState();
  const restored = readState(location.hash.slice(1));
  show();
  if (restored) (ROOT.closest("section") ?? ROOT).scrollIntoView();
  window.addEventListener("hashchange", () => readState(location.hash.slice(1)) && show());
  let width = ROOT.clientWidth;
  const resized = () => {
    if (width !== ROOT.clientWidth) requestAnimationFrame(show);
    width = ROOT.clientWidth;
  };
  new ResizeObserver(resized).observe(ROOT);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", show);
  new MutationObserver(show).observe(document.documentElement, { attributeFilter: ["data-theme"] });
}

start();
