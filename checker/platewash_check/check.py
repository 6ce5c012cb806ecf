"""All answers on a plan, in the order of the certificate."""

from . import exact, shares, statements
from .clearance import Clearance
from .motion import Motion
from .verdict import judged, not_checked
from .washing import Washing


def check(arm, plan, progress=lambda words: None, moments=0):
    """Yields an answer for each requirement of the certificate, and on the rounding at some random moments."""
    motion = Motion(plan.t, plan.q, plan.qd)
    if moments:
        yield exact.answer(arm, plan, motion, moments)
    clearance = Clearance(arm, plan, motion)
    yield from statements.answers(arm, plan, motion, clearance)
    progress("speeds, tilt and path")
    washing = Washing(arm, plan, motion)
    yield from washing.answers()
    if plan.cell.get("reduced_clearances"):
        yield not_checked("reduced_clearance", "clearances that a job reduces are not checked by this version")
    found, pair, when = clearance.run(lambda share: progress(f"clearance: {100 * share:.0f} %"))
    required = plan.requirements["clearance_m"]
    words = f"{pair[0]} and {pair[1]}, at {when:.4f} s" if pair else ""
    yield judged("clearance", found, required, "m", words, at_least=True)
    yield from shares.answers(washing, progress)
    if plan.requirements.get("holder") and not plan.requirements.get("contact"):
        yield not_checked("plate_stays", "without contact no load is known")
