"""Plans of scenarios, for the tests of the wheel."""

import pyplatewash as pw


def scenario(given: pw.Scenario | str, seed: int | None = None) -> pw.Scenario:
    """A scenario, or the shipped one of that name, with another seed if there is one."""
    found = pw.Scenario.load(given) if isinstance(given, str) else given
    return found if seed is None else found.replace(seed=seed)


def planned(given: pw.Scenario | str, seed: int | None = None) -> pw.Planned:
    """The washing of a scenario, planned."""
    return pw.plan(scenario(given, seed).job())


def plan(given: pw.Scenario | str, seed: int | None = None) -> pw.Plan:
    """The plan of a scenario's washing."""
    return planned(given, seed).plan


def paper_run(given: pw.Scenario | str) -> pw.PaperRun:
    """A scenario's run of the paper's program."""
    return pw.run_paper(scenario(given).paper_job())
