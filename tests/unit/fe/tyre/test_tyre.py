import pickle

import numpy as np
import pytest

from nptcs.config.solvers.fe import GroundContact, TyreMesh
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.tyre.contact import Ground
from nptcs.fe.tyre.equilibrium import TyreError, TyreModel
from nptcs.fe.tyre.mesh import band_radii, build_ring

GAUSS = np.polynomial.legendre.leggauss(4)

TYRE = TyreGeometry()
MESH = TyreMesh(gap_elements=2)


@pytest.fixture(scope="module")
def tyre(springs):
    def make(table=None, contact=None, mesh=MESH):
        contact = contact or GroundContact()
        return TyreModel(TYRE, table or springs(), 7.0, 5.0, 2000.0, mesh, contact)

    return make


@pytest.fixture(scope="module")
def loaded(tyre):
    model = tyre(contact=GroundContact(friction=0.0))
    return model, model.load(np.linspace(250.0, 3000.0, 12).tolist())


def test_the_ring_closes_and_has_the_tyres_area(tyre):
    ring = build_ring(TYRE, MESH, 7.0)
    model = tyre()
    inner, outer = band_radii(TYRE)
    area = np.pi * ((TYRE.outer_diameter_mm / 2) ** 2 - inner**2)
    assert (inner, outer) == (300.0, 314.0)
    rubber = sum(block.weight.sum() for block in model.rubbers)
    assert rubber == pytest.approx(area * TYRE.tread_width_mm, rel=1e-5)
    hoops = sum(wire.weight.sum() for wire in model.wires if wire.stiffness[:, 0, 0].any())
    section = np.pi / 4 / 2.0 * TYRE.tread_width_mm * 2
    length = np.pi * (TYRE.inner_wire_diameter_mm + TYRE.outer_wire_diameter_mm)
    assert hoops == pytest.approx(section * length, rel=1e-4)
    assert len(ring.feet) == 60


def test_bent_wires_store_the_energy_of_a_thin_ring(tyre):
    """Inextensional mode w = a cos 2θ: U = π/2 · E I (3a)² / R³ for each wire layer."""
    model = tyre(mesh=TyreMesh(gap_elements=4, foot_elements=2))
    amplitude = 1e-3
    layers = zip((model.wires[:3], model.wires[3:]), (300.75, 313.25), strict=True)
    for blocks, middle in layers:
        x, y = model.mesh.positions.T
        theta, radius = np.arctan2(x, -y), np.hypot(x, y)
        w, slope = amplitude * np.cos(2 * theta), -2.0 * amplitude * np.sin(2 * theta)
        v = -0.5 * amplitude * np.sin(2 * theta)
        along = v + (radius - middle) / middle * (v - slope)
        outward = np.stack([np.sin(theta), -np.cos(theta)], axis=1)
        tangent = np.stack([np.cos(theta), np.sin(theta)], axis=1)
        moved = w[:, None] * outward + along[:, None] * tangent
        wires = TYRE.tread_width_mm / TYRE.wire_pitch_mm * 2
        inertia = wires * np.pi * TYRE.wire_diameter_mm**4 / 64
        expected = np.pi / 2 * TYRE.wire_modulus_mpa * inertia * (3 * amplitude) ** 2 / middle**3
        energy = sum(block.respond(moved).energy for block in blocks)
        assert energy == pytest.approx(expected, rel=0.01)


def test_a_finer_ring_changes_the_stiffness_little(tyre):
    """The compressed wires of a finer ring must not buckle between its nodes."""
    coarse = tyre(mesh=TyreMesh()).load([1500.0, 3000.0])
    fine = tyre(mesh=TyreMesh(gap_elements=4)).load([1500.0, 3000.0])
    assert fine.rise_mm == pytest.approx(coarse.rise_mm, rel=0.005)


def test_a_band_that_does_not_cover_its_wires_is_refused():
    with pytest.raises(ValueError, match="does not cover"):
        build_ring(TYRE.model_copy(update={"shear_band_thickness_mm": 13.0}), MESH, 7.0)


def test_feet_that_overlap_are_refused():
    with pytest.raises(ValueError, match="overlap"):
        build_ring(TYRE, MESH, 35.0)


def test_a_foot_reports_the_motion_that_it_is_given(tyre):
    model = tyre()
    ring = model.mesh
    motion = np.array([0.3, -0.2, 1e-4])
    spoke = 7
    angle = ring.spoke_angle[spoke]
    radial = np.array([np.sin(angle), -np.cos(angle)])
    along = np.array([np.cos(angle), np.sin(angle)])
    arm = (ring.positions - 300.0 * radial) @ along
    displacement = (motion[0] + arm[:, None] * motion[2]) * radial + motion[1] * along

    assert model.spoke_motion(displacement)[spoke] == pytest.approx(motion, rel=1e-6)


def test_the_ground_carries_the_load_and_the_spokes_carry_it_on(loaded):
    model, state = loaded
    ground = model.ground.respond(state.displacement, state.rise_mm)
    assert ground.reaction_n == pytest.approx(3000.0, rel=1e-6)
    _, force, _ = model.table.evaluate(state.motion)
    angle = model.mesh.spoke_angle
    up = force[:, 0] * -np.cos(angle) + force[:, 1] * np.sin(angle)
    assert -up.sum() == pytest.approx(-3000.0, rel=1e-3)


def test_the_work_of_the_load_is_the_energy_stored(loaded):
    model, state = loaded
    force, rise = np.array(state.path.force_n), np.array(state.path.rise_mm)
    work = np.trapezoid(force, rise)
    assert sum(model.energy(state).values()) == pytest.approx(work, rel=0.01)


def test_symmetric_spokes_deform_symmetrically(loaded):
    _, state = loaded
    left, right = state.motion[1:30], state.motion[:30:-1]
    assert left[:, 0] == pytest.approx(right[:, 0], abs=1e-4)
    assert left[:, 1] == pytest.approx(-right[:, 1], abs=1e-4)


def test_the_band_is_flat_on_the_ground(loaded):
    model, state = loaded
    place, pressure = model.ground.pressure_profile(state.displacement, state.rise_mm)
    assert 20.0 < np.ptp(place[pressure > 0]) < 200.0
    line = model.neutral_line(state.displacement)
    bottom = line[(np.abs(line[:, 0]) < 10.0) & (line[:, 1] < 0.0)]
    assert np.ptp(bottom[:, 1]) < 0.1
    assert np.hypot(*model.neutral_line(np.zeros_like(state.displacement)).T) == pytest.approx(
        307.0
    )


def test_friction_stiffens_a_little(tyre, loaded):
    _, free = loaded
    rough = tyre(contact=GroundContact(friction=0.8)).load([1000.0, 2000.0, 3000.0])
    assert 0.97 * free.rise_mm < rough.rise_mm < free.rise_mm


def test_a_spoke_that_leaves_its_table_ends_the_case_with_its_last_point(tyre, springs):
    model = tyre(springs(low=-4.0))
    with pytest.raises(TyreError, match=r"outside the table.*last converged") as caught:
        model.load([500.0, 1000.0, 5000.0])
    assert 0.0 < caught.value.path.force_n[-1] < 5000.0
    returned = pickle.loads(pickle.dumps(caught.value))
    assert str(returned) == str(caught.value)


def test_contact_force_is_the_derivative_of_its_energy_and_friction_is_limited():
    positions = np.array([[-2.0, -100.0], [0.0, -100.0], [2.0, -100.0]])
    edges = np.array([[0, 1, 2]])
    ground = Ground(positions, edges, GAUSS, 10.0, GroundContact(friction=0.3))
    radius = float(np.hypot(2.0, 100.0))
    for depth in (0.001, 0.03):
        rise = radius - 100.0 + depth
        still = np.zeros_like(positions)
        response = ground.respond(still, rise)
        step = 1e-6
        slope = (ground.energy(still, rise + step) - ground.energy(still, rise - step)) / (2 * step)
        assert response.reaction_n == pytest.approx(slope, rel=1e-6)
        slid = np.zeros_like(positions)
        slid[:, 0] = 5.0
        shear = ground.respond(slid, rise).force.reshape(3, 2)[:, 0].sum()
        assert shear == pytest.approx(0.3 * response.reaction_n, rel=1e-6)


def test_contact_tangents_are_differences_of_the_force():
    positions = np.array([[-2.0, -100.0], [0.0, -100.0], [2.0, -100.0]])
    ground = Ground(positions, np.array([[0, 1, 2]]), GAUSS, 10.0, GroundContact())
    rise = float(np.hypot(2.0, 100.0)) - 100.0 + 0.0015
    rng = np.random.default_rng(0)
    here = 0.0005 * rng.normal(size=positions.shape)
    direction = rng.normal(size=positions.shape)
    step = 1e-7
    ahead = ground.respond(here + step * direction, rise).force
    behind = ground.respond(here - step * direction, rise).force
    tangent = ground.respond(here, rise).tangent[0] @ direction.ravel()
    assert (ahead - behind)[0] / (2 * step) == pytest.approx(tangent, rel=1e-4, abs=1e-4)
