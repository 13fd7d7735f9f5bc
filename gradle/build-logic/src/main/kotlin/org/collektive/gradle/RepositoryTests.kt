package org.collektive.gradle

import org.gradle.api.tasks.PathSensitivity
import org.gradle.api.tasks.testing.Test

/** Lets tests find the repository and flatc. They read [paths] of it, so they run again when something there changes. */
public fun Test.readsRepository(vararg paths: String) {
    inputs.files(paths.map(project.rootDir::resolve), project.flatc)
        .withPropertyName("repository")
        .withPathSensitivity(PathSensitivity.RELATIVE)
    systemProperty("collektive.root", project.rootDir.path)
    systemProperty("collektive.flatc", project.flatc.path)
}
