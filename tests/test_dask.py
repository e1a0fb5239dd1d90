"""Many orders on a Dask cluster, through joblib, against the same on one core."""

import os
import time

import joblib
import numpy as np
import pytest

from meshlib import local_optima, problems
from meshlib.optima.many_orders import shared

distributed = pytest.importorskip("distributed")


@pytest.fixture(scope="module")
def cluster():
    """Two processes on this machine; yields what joblib is told."""
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster),
    ):
        yield {"backend": "dask"}


@pytest.mark.parametrize("arguments", [{}, {"workers": -1, "progress": True}])
def test_a_cluster_finds_what_one_core_finds(cluster, arguments):
    problem = problems.mesh("33"), problems.SR2, "abn"
    alone = local_optima(*problem, norm="L1", orders=70, workers=1)
    with joblib.parallel_config(**cluster):
        found = local_optima(*problem, norm="L1", orders=70, **arguments)
    for name in ("elements", "costs", "optimum"):
        assert np.array_equal(getattr(found, name), getattr(alone, name))


def process():
    """A process that has time for nothing else meanwhile."""
    time.sleep(0.02)
    return os.getpid()


@pytest.mark.parametrize("workers", [None, -1])
def test_both_processes_of_the_cluster_work(cluster, workers):
    with joblib.parallel_config(**cluster):
        found = set(shared(process, [()] * 40, workers))
    assert len(found) == 2 and os.getpid() not in found


def test_results_come_in_order_with_a_bar(cluster, capsys):
    with joblib.parallel_config(**cluster):
        found = list(shared(divmod, [(k, 7) for k in range(40)], progress=True, total=40))
    assert found == [divmod(k, 7) for k in range(40)]
    assert "40/40" in capsys.readouterr().err


def test_who_stops_asking_stops_the_work(cluster):
    with joblib.parallel_config(**cluster):
        results = shared(process, [()] * 10_000)
        next(results)
        results.close()
        assert len(list(shared(process, [()] * 2))) == 2


def test_without_a_configuration_there_is_one_process():
    assert set(shared(os.getpid, [()] * 4)) == {os.getpid()}
    with joblib.parallel_config(n_jobs=2):
        assert os.getpid() not in set(shared(os.getpid, [()] * 4))
