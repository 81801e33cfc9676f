# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies: ensembles of surfaces from one configuration, and checks of the installation."""

from ._core import (
    AdhesionOfSurface as AdhesionOfSurface,
    AdhesionSample as AdhesionSample,
    Check as Check,
    DampingPoint as DampingPoint,
    EnsembleMean as EnsembleMean,
    ModelResult as ModelResult,
    Realisation as Realisation,
    SpotStatistics as SpotStatistics,
    StudyConfiguration as StudyConfiguration,
    StatedMean as StatedMean,
    StudySolution as StudySolution,
    EnsembleWarning as EnsembleWarning,
    StudyResult as StudyResult,
    SurfacePicture as SurfacePicture,
    contact_models as contact_models,
    is_result_of as is_result_of,
    parse_study_configuration as parse_study_configuration,
    read_study_configuration as read_study_configuration,
    run_ensembles as run_ensembles,
    run_study as run_study,
    verify_installation as verify_installation,
    write_ensembles as write_ensembles,
)
