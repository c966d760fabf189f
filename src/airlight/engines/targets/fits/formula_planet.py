"""Planet of at most three constituents by the formulas of real-time programs.

Molecules and particles have exponential profiles, the absorber an exponential or a tent.
Constituents with a Rayleigh phase function are merged into the first, other scatterers into the
second, with their absorption; pure absorbers, and absorption by molecules, into the third. Spectral
vertical optical depths are preserved.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, Literal

import numpy as np
from numpy.typing import NDArray

from airlight.engines.baking.air_light import groups
from airlight.engines.targets.fits.lobe import Lobe, LobeForm, particles_lobe
from airlight.engines.targets.fits.vertical_profile import (
    VerticalProfile,
    fit_exponential,
    fit_tent,
)
from airlight.engines.targets.target import FittedFormula
from airlight.physics.optics.reflection import mean_albedo
from airlight.planets.constituent import Constituent
from airlight.planets.ground import Ground
from airlight.planets.matter.phases import PhaseFunction, Rayleigh
from airlight.planets.matter.profiles import Profile
from airlight.planets.planet import Planet
from airlight.planets.spectral import PerWavelength
from airlight.planets.star import Star

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]

#: Names of the constituents.
MOLECULES: Final = "molecules"
PARTICLES: Final = "particles"
ABSORBER: Final = "absorber"
#: Optical depth below which absorption is ignored. [1]
_NOTHING: Final = 1e-12


@dataclass(frozen=True, kw_only=True)
class Formulas:
    """Formulas of a program.

    Attributes
    ----------
    lobe : LobeForm
        Phase function of its particles.
    absorber : str
        ``tent``, ``exponential``, ``with particles`` (with their scale height), or ``none``.
    grey : bool
        Whether scattering by particles is independent of wavelength.
    one_albedo : bool
        Whether the single-scattering albedo of particles is independent of wavelength.
    """

    lobe: LobeForm
    absorber: Literal["tent", "exponential", "with particles", "none"]
    grey: bool = False
    one_albedo: bool = False


@dataclass(frozen=True, kw_only=True)
class FormulaPlanet:
    """Planet by formulas, and the fitted formulas.

    Attributes
    ----------
    planet : Planet
        Planet with some of the constituents ``molecules``, ``particles`` and ``absorber``.
    fitted : tuple of FittedFormula
        Fits with their errors.
    notes : tuple of str
        Omitted properties.
    g : float
        Parameter of the particles' lobe; 0 without particles. [1]
    """

    planet: Planet
    fitted: tuple[FittedFormula, ...]
    notes: tuple[str, ...]
    g: float

    @property
    def parts(self) -> tuple[Constituent | None, Constituent | None, Constituent | None]:
        """Molecules, particles and absorber; None for those that it does not have."""
        found = {one.name: one for one in self.planet.constituents}
        return found.get(MOLECULES), found.get(PARTICLES), found.get(ABSORBER)


def formula_planet(medium: Medium, name: str, formulas: Formulas) -> FormulaPlanet:
    """Fit a medium by formulas.

    Parameters
    ----------
    medium : Medium
        Medium without refraction.
    """
    gas, particles = groups(medium)
    others = [index for index in range(len(medium.names)) if index not in particles]
    columns = medium.columns[:, None]
    fitted: list[FittedFormula] = []
    notes = _left_out(medium)
    constituents: list[Constituent] = []
    scattered = (medium.scattering * columns)[gas].sum(axis=0)
    absorbed = (medium.absorption * columns)[others].sum(axis=0)
    none, g = np.zeros_like(absorbed), 0.0
    if particles:
        profile = _fitted_profile(
            medium, particles, medium.extinction, PARTICLES, "exponential", fitted
        )
        held, taken, surplus = _limited(
            (medium.scattering * columns)[particles].sum(axis=0),
            (medium.absorption * columns)[particles].sum(axis=0),
            formulas,
            fitted,
        )
        if formulas.absorber == "with particles":
            taken, absorbed = taken + absorbed, none
        lobe = particles_lobe(medium, formulas.lobe)
        assert lobe is not None
        fitted.append(_fitted_formula(lobe))
        g = lobe.g
        phase = formulas.lobe.phase_function(g)
        constituents.append(layer(PARTICLES, profile, medium, held, taken, phase))
        scattered = scattered + surplus
    if gas:
        profile = _fitted_profile(medium, gas, medium.scattering, MOLECULES, "exponential", fitted)
        fitted.append(_rayleigh(medium, gas))
    if scattered.any():
        constituents.insert(0, layer(MOLECULES, profile, medium, scattered, none, Rayleigh()))
    if absorbed.max() > _NOTHING:
        if formulas.absorber == "none":
            share = float(absorbed.max())
            notes.append(f"absorption by gases is left out: optical depth {share:.3g} at most")
        else:
            form: Literal["exponential", "tent"] = (
                "tent" if formulas.absorber == "tent" else "exponential"
            )
            profile = _fitted_profile(medium, others, medium.absorption, ABSORBER, form, fitted)
            constituents.append(layer(ABSORBER, profile, medium, none, absorbed, None))
    ground = medium.ground
    albedo = mean_albedo(ground)
    planet = Planet(
        name=name,
        bottom_radius=medium.bottom_radius,
        top_radius=medium.top_radius,
        ground=Ground(albedo=per_wavelength(medium.wavelengths, albedo)),
        star=Star(
            irradiance=per_wavelength(medium.wavelengths, medium.solar_irradiance),
            angular_radius=math.degrees(medium.star_angular_radius),
        ),
        constituents=tuple(constituents),
        default_wavelengths=tuple(medium.wavelengths.tolist()),
    )
    return FormulaPlanet(planet=planet, fitted=tuple(fitted), notes=tuple(notes), g=g)


def name_of(planet: Planet | None) -> str:
    """Identifier from a planet's name: letters and digits, the first a letter.

    Examples
    --------
    >>> name_of(None)
    'Planet'
    """
    words = (
        "".join(one if one.isascii() and one.isalnum() else " " for one in planet.name).split()
        if planet
        else []
    )
    name = "".join(word[:1].upper() + word[1:] for word in words)
    return name if name[:1].isalpha() else f"Planet{name}"


def per_wavelength(wavelengths: FloatArray, values: FloatArray) -> PerWavelength:
    """Values as a parameter of a planet."""
    return PerWavelength(
        wavelengths=tuple(float(nm) for nm in wavelengths),
        values=tuple(float(value) for value in values),
    )


def layer(
    name: str,
    profile: Profile,
    medium: Medium,
    scattered: FloatArray,
    absorbed: FloatArray,
    phase: PhaseFunction | None,
) -> Constituent:
    """Constituent with given vertical optical depths.

    Parameters
    ----------
    profile : Profile
        Density.
    medium : Medium
        Medium with the wavelengths and the thickness.
    scattered, absorbed : array, shape (nl,)
        Vertical optical depths of scattering and absorption. [1]
    phase : PhaseFunction or None
        Phase function, if it scatters.
    """
    column = profile.column(medium.thickness)
    nm = medium.wavelengths
    return Constituent(
        name=name,
        profile=profile,
        scattering=per_wavelength(nm, scattered / column) if phase is not None else 0.0,
        absorption=per_wavelength(nm, absorbed / column),
        phase_function=phase,
    )


def _fitted_profile(
    medium: Medium,
    members: Sequence[int],
    coefficients: FloatArray,
    name: str,
    form: Literal["exponential", "tent"],
    fitted: list[FittedFormula],
) -> Profile:
    """Total density of several constituents, weighted by their coefficients."""
    weights = coefficients[list(members)].mean(axis=1)
    whole = VerticalProfile.sampled(
        lambda h: weights @ medium.density.at(h)[list(members)],
        medium.thickness,
        medium.bottom_radius,
    )
    profile: Profile
    if form == "tent":
        tent = fit_tent(whole)
        parameters = {"centre [km]": tent.center / 1e3, "half width [km]": tent.half_width / 1e3}
        profile = tent
    else:
        exponential = fit_exponential(whole)
        parameters = {"scale height [km]": exponential.scale_height / 1e3}
        profile = exponential
    names = " + ".join(medium.names[index] for index in members if coefficients[index].any())
    fitted.append(
        FittedFormula(
            name=f"{names}: density",
            form=f"{form}, as {name}",
            parameters=parameters,
            errors=whole.errors(profile),
            where=f"0 to {medium.thickness / 1e3:g} km; the vertical column is kept",
        )
    )
    return profile


def _fitted_formula(lobe: Lobe) -> FittedFormula:
    return FittedFormula(
        name=f"{PARTICLES}: phase function",
        form=lobe.form.name,
        parameters={"g": lobe.g, "mean cosine": lobe.mean_cosine},
        errors=lobe.errors,
        where="the mean cosine is kept, averaged over wavelengths by optical depth",
    )


def _rayleigh(medium: Medium, gas: Sequence[int]) -> FittedFormula:
    """Rayleigh phase function without depolarisation, in place of that of the molecules."""
    nu = np.linspace(-1.0, 1.0, 181)
    own = medium.phase_function(nu)[:, list(gas)]
    plain = Rayleigh().values(nu, medium.wavelengths)[:, None, :]
    return FittedFormula(
        name=f"{MOLECULES}: phase function",
        form="Rayleigh without depolarisation",
        parameters={},
        errors={"largest, relative": float(np.abs(plain / own - 1.0).max())},
        where="0 to 180 deg",
    )


def _limited(
    scattered: FloatArray, absorbed: FloatArray, formulas: Formulas, fitted: list[FittedFormula]
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Optical depths of particles as a program represents them, and the remaining scattering.

    With one albedo, scattering is preserved, which gives better colours of Mars and Titan. If grey,
    scattering is the minimum over wavelengths, and the remainder is added to the molecules.
    """
    nothing = np.zeros_like(scattered)
    if formulas.grey and scattered.max() > scattered.min():
        held = np.full_like(scattered, scattered.min())
        moved = scattered - held
        errors = {"scattered as molecules, largest share": float((moved / scattered).max())}
        _note_color(fitted, "grey scattering, the rest as molecules", errors)
        return held, absorbed, moved
    if formulas.one_albedo:
        albedo = float(scattered.sum() / (scattered + absorbed).sum())
        extinction = scattered / albedo
        error = float(np.abs(extinction / (scattered + absorbed) - 1.0).max())
        errors = {"optical depth, largest, relative": error}
        _note_color(fitted, "one single scattering albedo", errors, {"albedo": albedo})
        return scattered, extinction - scattered, nothing
    return scattered, absorbed, nothing


def _note_color(
    fitted: list[FittedFormula],
    form: str,
    errors: dict[str, float],
    parameters: dict[str, float] | None = None,
) -> None:
    fitted.append(
        FittedFormula(
            name=f"{PARTICLES}: colour",
            form=form,
            parameters=parameters or {},
            errors=errors,
            where="the wavelengths of the program",
        )
    )


def _left_out(medium: Medium) -> list[str]:
    notes = []
    if medium.surface.map is not None:
        notes.append("the map of the ground is left out: give the program its own")
    if medium.surface.deck is not None:
        notes.append("the map of the deck is left out: its mean is shown")
    if medium.surface.lights is not None:
        notes.append("lights of towns are left out")
    if medium.surface.clouds is not None:
        notes.append(
            f"clouds are part of the ground's albedo: cover {medium.ground.cover:.2g}, no layer"
        )
    if medium.ground.law != 0 or medium.ground.wet:
        notes.append("the ground reflects alike into all directions, without a glint")
    return notes
