import org.collektive.gradle.readsRepository

plugins {
    id("org.collektive.kotlin-module")
}

val testedModules = listOf(
    "spi",
    "dsl",
    "runtime",
    "mailbox",
    "compiler-plugin",
    "stdlib",
    "api",
    "engine",
    "generator",
    "frames",
    "testing",
    "host",
    "tools",
    "programs",
    "bench",
)

dependencies {
    for (module in testedModules) testImplementation(project(":$module"))
    testImplementation(libs.archunit)
}

tasks.test {
    val poms =
        listOf("pom.xml", "flatbuffers/pom.xml", "lifter/pom.xml", "fielded/pom.xml", "architecture/pom.xml") +
            testedModules.map { "$it/pom.xml" }
    readsRepository(
        "docs/architecture.md",
        "gradle.properties",
        "gradle/libs.versions.toml",
        "settings.gradle.kts",
        *poms.map { "jvm-host/$it" }.toTypedArray(),
    )
}
